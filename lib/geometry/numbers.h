// Motions and points as flat numbers, in the order of the file format: (x, y, theta) and (x, y, z,
// qx, qy, qz, qw). Nothing is normalized on the way: text rounds quaternions, and `normalized`
// (se3.h) brings one to unit length where that is meant.
#pragma once

#include <algorithm>
#include <array>

#include "lib/geometry/se2.h"
#include "lib/geometry/se3.h"

namespace sg::geometry {

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

// The same motion in the plane z = 0 of space.
inline SE3 in_space(const SE2& a) {
  return {exp_so3({0, 0, a.theta}), {a.x, a.y, 0}};
}

inline std::array<double, 3> numbers_of(const SE2& a) {
  return {a.x, a.y, a.theta};
}
inline std::array<double, 7> numbers_of(const SE3& a) {
  return {a.t.x(), a.t.y(), a.t.z(), a.q.x(), a.q.y(), a.q.z(), a.q.w()};
}
inline void set_se2(const SE2& a, double* x) {
  std::ranges::copy(numbers_of(a), x);
}
inline void set_se3(const SE3& a, double* x) {
  std::ranges::copy(numbers_of(a), x);
}

}  // namespace sg::geometry
