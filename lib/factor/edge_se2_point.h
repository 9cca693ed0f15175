// Landmarks seen from poses in the plane.
//   EDGE_SE2_XY          e = x^-1 l - z
//   EDGE_BEARING_SE2_XY  e = z - atan2 of x^-1 l, wrapped
#pragma once

#include <cmath>

#include "lib/factor/model.h"
#include "lib/geometry/numbers.h"

namespace sg::factor {

template <>
struct EdgeModel<graph::EdgeTag::se2_xy> : Registered<graph::EdgeTag::se2_xy> {
  static void evaluate(const double* const* x, const double* c, double* e, double* const* J) {
    const double cs = std::cos(x[0][2]), sn = std::sin(x[0][2]);
    const double dx = x[1][0] - x[0][0], dy = x[1][1] - x[0][1];
    const double u = cs * dx + sn * dy, v = cs * dy - sn * dx;
    e[0] = u - c[0];
    e[1] = v - c[1];
    if (!J) return;
    Eigen::Map<Eigen::Matrix<double, 2, 3>>(J[0]) << -cs, -sn, v, sn, -cs, -u;
    Eigen::Map<Eigen::Matrix2d>(J[1]) << cs, sn, -sn, cs;
  }

  static bool place(const double* const* x, const double* c, int end, double* out) {
    if (end != 1) return false;
    Eigen::Map<Eigen::Vector2d>{out} = act(geometry::se2(x[0]), geometry::vector2(c));
    return true;
  }
};

template <>
struct EdgeModel<graph::EdgeTag::bearing_se2_xy> : Registered<graph::EdgeTag::bearing_se2_xy> {
  static void evaluate(const double* const* x, const double* c, double* e, double* const* J) {
    const double dx = x[1][0] - x[0][0], dy = x[1][1] - x[0][1];
    e[0] = geometry::wrap(c[0] + x[0][2] - std::atan2(dy, dx));
    if (!J) return;
    const double square = dx * dx + dy * dy;
    const double slope_x = dy / square, slope_y = -dx / square;
    Eigen::Map<Eigen::RowVector3d>(J[0]) << -slope_x, -slope_y, 1;
    Eigen::Map<Eigen::RowVector2d>(J[1]) << slope_x, slope_y;
  }

  static Ray rays(const double* const* x, const double* c) {
    const double angle = x[0][2] + c[0], cs = std::cos(angle), sn = std::sin(angle);
    Ray ray;
    ray.rows = 1;
    ray.row[0] = {-sn, cs, 0, cs * x[0][1] - sn * x[0][0]};
    ray.origin = {x[0][0], x[0][1], 0};
    ray.ahead = {cs, sn, 0};
    return ray;
  }
};

}  // namespace sg::factor
