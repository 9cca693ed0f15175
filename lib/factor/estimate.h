// Estimates and measurements as flat numbers, seen as geometry. The orders are those of the file
// format: (x, y, theta) and (x, y, z, qx, qy, qz, qw).
#pragma once

#include "lib/geometry/se2.h"
#include "lib/geometry/se3.h"

namespace sg {

inline Eigen::Map<const Eigen::Vector2d> vector2(const double* x) {
  return Eigen::Map<const Eigen::Vector2d>(x);
}
inline Eigen::Map<const Eigen::Vector3d> vector3(const double* x) {
  return Eigen::Map<const Eigen::Vector3d>(x);
}
inline SE2 se2(const double* x) {
  return {x[0], x[1], x[2]};
}
inline SE3 se3(const double* x) {
  return {Eigen::Quaterniond(x[6], x[3], x[4], x[5]), vector3(x)};
}
inline void set_se2(const SE2& a, double* x) {
  x[0] = a.x;
  x[1] = a.y;
  x[2] = a.theta;
}
inline void set_se3(const SE3& a, double* x) {
  Eigen::Map<Eigen::Vector3d>{x} = a.t;
  Eigen::Map<Eigen::Vector4d>{x + 3} = a.q.coeffs();
}

}  // namespace sg
