// Relative and absolute poses in the plane.
//   EDGE_SE2         e = (z^-1 (x_i^-1 x_j))  as (x, y, theta)
//   EDGE_SE2_OFFSET  the same between the sensors x_i p_i and x_j p_j
//   EDGE_PRIOR_SE2   e = (z^-1 x)
//   EDGE_PRIOR_SE2_XY  e = (x, y) - z
// Steps add to (x, y, theta), hence the Jacobians are those of the composition in these coordinates
// (Smith, Self, Cheeseman, eq. 12 and appendix).
#pragma once

#include <cmath>

#include "lib/factor/model.h"
#include "lib/geometry/numbers.h"

namespace sg::factor {

// The end that a motion z between two poses gives by the other one.
inline bool place_end(const double* const* x, const SE2& z, int end, double* out) {
  set_se2(end == 1 ? compose(geometry::se2(x[0]), z) : compose(geometry::se2(x[1]), inverse(z)),
          out);
  return true;
}

template <>
struct EdgeModel<graph::EdgeTag::se2> : Registered<graph::EdgeTag::se2> {
  static constexpr int constants = 5;

  // c = z, cos and sin of its angle
  static bool prepare(const double* z, const double* const*, double* c) {
    set_se2(geometry::se2(z), c);
    c[3] = std::cos(z[2]);
    c[4] = std::sin(z[2]);
    return true;
  }

  static void evaluate(const double* const* x, const double* c, double* e, double* const* J) {
    const double* i = x[0];
    const double* j = x[1];
    const double ci = std::cos(i[2]), si = std::sin(i[2]), cz = c[3], sz = c[4];
    const double dx = j[0] - i[0], dy = j[1] - i[1];
    const double u = ci * dx + si * dy - c[0], v = ci * dy - si * dx - c[1];
    e[0] = cz * u + sz * v;
    e[1] = cz * v - sz * u;
    e[2] = geometry::wrap(j[2] - i[2] - c[2]);
    if (!J) return;
    const double cs = cz * ci - sz * si, sn = sz * ci + cz * si;  // of theta_i + theta_z
    Eigen::Map<Eigen::Matrix3d>(J[1]) << cs, sn, 0, -sn, cs, 0, 0, 0, 1;
    Eigen::Map<Eigen::Matrix3d>(J[0]) << -cs, -sn, cs * dy - sn * dx, sn, -cs, -cs * dx - sn * dy,
        0, 0, -1;
  }

  static bool place(const double* const* x, const double* c, int end, double* out) {
    return place_end(x, geometry::se2(c), end, out);
  }
};

template <>
struct EdgeModel<graph::EdgeTag::se2_offset> : Registered<graph::EdgeTag::se2_offset> {
  static constexpr int constants = 9;

  // c = z, p_i, p_j
  static bool prepare(const double* z, const double* const* p, double* c) {
    set_se2(geometry::se2(z), c);
    set_se2(geometry::se2(p[0]), c + 3);
    set_se2(geometry::se2(p[1]), c + 6);
    return true;
  }

  // With a = p_i z and the lever p_j:  e = a^-1 (x_i^-1 x_j) p_j, turned back by nothing: z^-1
  // p_i^-1 = a^-1.
  static void evaluate(const double* const* x, const double* c, double* e, double* const* J) {
    const SE2 i = geometry::se2(x[0]), j = geometry::se2(x[1]), to = geometry::se2(c + 6);
    const SE2 a = compose(geometry::se2(c + 3), geometry::se2(c));
    set_se2(between(a, compose(between(i, j), to)), e);
    if (!J) return;
    const Eigen::Matrix2d back = geometry::rotation(-i.theta - a.theta);
    const Eigen::Vector2d lever = geometry::rotation(j.theta) * Eigen::Vector2d(to.x, to.y);
    const Eigen::Vector2d reach = Eigen::Vector2d(j.x - i.x, j.y - i.y) + lever;
    const Eigen::Matrix2d quarter{{0, -1}, {1, 0}};
    Eigen::Map<Eigen::Matrix3d> Ji(J[0]), Jj(J[1]);
    Ji << -back, -back * quarter * reach, 0, 0, -1;
    Jj << back, back * quarter * lever, 0, 0, 1;
  }

  static bool place(const double* const* x, const double* c, int end, double* out) {
    const SE2 from = compose(geometry::se2(c + 3), geometry::se2(c));
    return place_end(x, compose(from, inverse(geometry::se2(c + 6))), end, out);
  }
};

template <>
struct EdgeModel<graph::EdgeTag::prior_se2> : Registered<graph::EdgeTag::prior_se2> {
  static void evaluate(const double* const* x, const double* c, double* e, double* const* J) {
    set_se2(between(geometry::se2(c), geometry::se2(x[0])), e);
    if (!J) return;
    const double cz = std::cos(c[2]), sz = std::sin(c[2]);
    Eigen::Map<Eigen::Matrix3d>(J[0]) << cz, sz, 0, -sz, cz, 0, 0, 0, 1;
  }

  static bool place(const double* const*, const double* c, int, double* out) {
    set_se2(geometry::se2(c), out);
    return true;
  }
};

template <>
struct EdgeModel<graph::EdgeTag::prior_se2_xy> : Registered<graph::EdgeTag::prior_se2_xy> {
  static void evaluate(const double* const* x, const double* c, double* e, double* const* J) {
    e[0] = x[0][0] - c[0];
    e[1] = x[0][1] - c[1];
    if (J) Eigen::Map<Eigen::Matrix<double, 2, 3>>(J[0]).setIdentity();
  }
};

}  // namespace sg::factor
