// The measurements and information matrices that iSAM and TORO share, to g2o's conventions and
// back.
//
// Both give a rotation as roll, pitch, yaw (lib/geometry/se3.h), radians. g2o gives a quaternion,
// and its information is over (dx, dy, dz, the vector part of dq) of a small motion d in the
// measurement's end frame.
//
// The information of (x, y, z, roll, pitch, yaw) is taken over the same small motion d, whose
// roll, pitch and yaw are, to first order, its rotation vector. That is how the readers of g2o and
// GTSAM take the planar files, too. The vector part of a quaternion is half the rotation vector, so
// with S = diag(1, 1, 1, 2, 2, 2)
//     W_g2o = S W S.
// Taken over differences of the six coordinates themselves, W would turn with the measurement's own
// rotation as well: a difference of second order for small angles.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "lib/geometry/se3.h"
#include "lib/geometry/triangle.h"
#include "lib/text/line.h"

namespace sg::formats {

// The symmetric matrix whose upper triangle stands at the front of `rest`.
template <int N>
Eigen::Matrix<double, N, N> read_symmetric(std::string_view& rest) {
  std::array<double, geometry::triangle_size(N)> triangle{};
  for (double& number : triangle) number = text::read_number(rest);
  return geometry::symmetric<Eigen::Matrix<double, N, N>>(triangle);
}

// " w11 w12 ...": the upper triangle.
template <int N>
void append_triangle(std::string& out, const Eigen::Matrix<double, N, N>& matrix) {
  text::append_numbers(out, geometry::upper_triangle(matrix));
}

// S W S and its inverse S^-1 W S^-1.
Matrix6d to_quaternion_information(const Matrix6d& information);
Matrix6d to_euler_information(const Matrix6d& information);

// "x y z roll pitch yaw" at the front of `rest`, appended as " x y z qx qy qz qw".
void translate_euler_pose(std::string_view& rest, std::string& out);
// "x y z qx qy qz qw" at the front of `rest`, appended as it is written; BadLine for a quaternion of
// length zero.
void copy_quaternion_pose(std::string_view& rest, std::string& out);
// The same, appended as " x y z roll pitch yaw".
void translate_quaternion_pose(std::string_view& rest, std::string& out);

}  // namespace sg::formats
