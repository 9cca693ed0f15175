// Relative and absolute poses in space.  e = (translation, vector part of the quaternion with w >=
// 0)  of
//   EDGE_SE3:QUAT    z^-1 x_i^-1 x_j
//   EDGE_SE3_OFFSET  z^-1 (x_i p_i)^-1 (x_j p_j)       p: sensor offsets, parameters
//   EDGE_SE3_PRIOR   z^-1 x p
// and EDGE_SE3_XYZ_PRIOR  e = translation of x - z      (g2o leaves its offset out of account, and
// so do we).
//
// A step d = (u, v) of a pose in the middle, a d b, moves the result's translation by R_a (u - 2
// [t_b]x v) and its quaternion by a (0, v) b; a step of an inverse pose, a d^-1 b, by as much with
// the other sign.
#pragma once

#include <cmath>
#include <initializer_list>

#include "lib/factor/model.h"
#include "lib/geometry/numbers.h"

namespace sg::factor {

inline bool prepare_se3(const double* numbers, double* c) {
  const SE3 z = geometry::se3(numbers);
  if (z.q.norm() < 1e-6) return false;
  set_se3(normalized(z), c);
  return true;
}

// The product of rotations. Text rounds quaternions, and g2o makes matrices of a file's estimates
// as they are: where the factors are not of unit length, so do we, for its chi-square is the number
// to give.
inline Eigen::Quaterniond rotation_product(std::initializer_list<Eigen::Quaterniond> factors) {
  Eigen::Quaterniond product = Eigen::Quaterniond::Identity();
  for (const auto& factor : factors) product = product * factor;
  if (std::abs(product.squaredNorm() - 1) < 1e-11) return product;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  for (const auto& factor : factors) R *= factor.toRotationMatrix();
  return Eigen::Quaterniond(R).normalized();
}

// The end that a motion z between two poses gives by the other one.
inline bool place_end(const double* const* x, const SE3& z, int end, double* out) {
  set_se3(end == 1 ? compose(geometry::se3(x[0]), z) : compose(geometry::se3(x[1]), inverse(z)),
          out);
  return true;
}

inline void set_error(const SE3& d, double* e) {
  Eigen::Map<Vector6d>{e} = compact(d);
}

// The vector part of a (0, v) b is this times v.
inline Eigen::Matrix3d vector_part(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  return (a.w() * identity + geometry::skew(a.vec())) *
             (b.w() * identity - geometry::skew(b.vec())) -
         a.vec() * b.vec().transpose();
}

// Jacobian of the error of a d b in the step d, times `sign`.
inline void set_jacobian(const SE3& a, const SE3& b, double sign, double* J) {
  const Eigen::Matrix3d R = sign * a.q.toRotationMatrix();
  const double flip = a.q.w() * b.q.w() - a.q.vec().dot(b.q.vec()) < 0 ? -sign : sign;
  Eigen::Map<Matrix6d> result(J);
  result.topLeftCorner<3, 3>() = R;
  result.topRightCorner<3, 3>() = -2 * R * geometry::skew(b.t);
  result.bottomLeftCorner<3, 3>().setZero();
  result.bottomRightCorner<3, 3>() = flip * vector_part(a.q, b.q);
}

template <>
struct EdgeModel<graph::EdgeTag::se3> : Registered<graph::EdgeTag::se3> {
  static constexpr int constants = 7;

  static bool prepare(const double* z, const double* const*, double* c) {
    return prepare_se3(z, c);
  }

  static void evaluate(const double* const* x, const double* c, double* e, double* const* J) {
    const SE3 a = inverse(geometry::se3(c));
    const SE3 b = between(geometry::se3(x[0]), geometry::se3(x[1]));
    const auto q =
        rotation_product({a.q, geometry::se3(x[0]).q.conjugate(), geometry::se3(x[1]).q});
    const SE3 d{q, a.q * b.t + a.t};
    set_error(d, e);
    if (!J) return;
    set_jacobian(a, b, -1, J[0]);
    set_jacobian(d, SE3{}, 1, J[1]);
  }

  static bool place(const double* const* x, const double* c, int end, double* out) {
    return place_end(x, geometry::se3(c), end, out);
  }
};

template <>
struct EdgeModel<graph::EdgeTag::se3_offset> : Registered<graph::EdgeTag::se3_offset> {
  static constexpr int constants = 21;

  // c = z, p_i, p_j
  static bool prepare(const double* z, const double* const* p, double* c) {
    set_se3(geometry::se3(p[0]), c + 7);
    set_se3(geometry::se3(p[1]), c + 14);
    return prepare_se3(z, c);
  }

  static void evaluate(const double* const* x, const double* c, double* e, double* const* J) {
    const SE3 z = geometry::se3(c), from = geometry::se3(c + 7), to = geometry::se3(c + 14),
              i = geometry::se3(x[0]), j = geometry::se3(x[1]);
    const auto q =
        rotation_product({z.q.conjugate(), from.q.conjugate(), i.q.conjugate(), j.q, to.q});
    const Eigen::Vector3d reach = act(j, to.t) - act(i, from.t);
    const Eigen::Vector3d seen = from.q.conjugate() * (i.q.conjugate() * reach);
    set_error({q, z.q.conjugate() * (seen - z.t)}, e);
    if (!J) return;
    const SE3 a = inverse(compose(from, z)), motion = between(i, j);
    set_jacobian(a, compose(motion, to), -1, J[0]);
    set_jacobian(compose(a, motion), to, 1, J[1]);
  }

  static bool place(const double* const* x, const double* c, int end, double* out) {
    const SE3 from = compose(geometry::se3(c + 7), geometry::se3(c));
    return place_end(x, compose(from, inverse(geometry::se3(c + 14))), end, out);
  }
};

template <>
struct EdgeModel<graph::EdgeTag::se3_prior> : Registered<graph::EdgeTag::se3_prior> {
  static constexpr int constants = 14;

  // c = z, p; of this type alone g2o leaves the measurement's quaternion as its text has it
  static bool prepare(const double* z, const double* const* p, double* c) {
    set_se3(geometry::se3(z), c);
    set_se3(geometry::se3(p[0]), c + 7);
    return geometry::se3(z).q.norm() > 1e-6;
  }

  static void evaluate(const double* const* x, const double* c, double* e, double* const* J) {
    const SE3 z = geometry::se3(c), pose = geometry::se3(x[0]), p = geometry::se3(c + 7);
    const auto q = rotation_product({z.q.conjugate(), pose.q, p.q});
    set_error({q, z.q.conjugate() * (act(pose, p.t) - z.t)}, e);
    if (J) set_jacobian(between(z, pose), p, 1, J[0]);
  }

  static bool place(const double* const*, const double* c, int, double* out) {
    const SE3 x = compose(geometry::se3(c), inverse(geometry::se3(c + 7)));
    set_se3(normalized(x), out);
    return true;
  }
};

template <>
struct EdgeModel<graph::EdgeTag::se3_xyz_prior> : Registered<graph::EdgeTag::se3_xyz_prior> {
  static void evaluate(const double* const* x, const double* c, double* e, double* const* J) {
    for (int k = 0; k < 3; ++k) e[k] = x[0][k] - c[k];
    if (!J) return;
    Eigen::Map<Eigen::Matrix<double, 3, 6>>(J[0]) << geometry::se3(x[0]).q.toRotationMatrix(),
        Eigen::Matrix3d::Zero();
  }
};

}  // namespace sg::factor
