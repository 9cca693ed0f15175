// The measurements and information matrices that iSAM and TORO share, to g2o's conventions and
// back.
//
// Both give a rotation as roll, pitch, yaw: R = Rz(yaw) Ry(pitch) Rx(roll), radians. g2o gives a
// quaternion, and its information is over (dx, dy, dz, the vector part of dq) of a small motion d
// in the measurement's end frame.
//
// The information of (x, y, z, roll, pitch, yaw) is taken over the same small motion d, whose
// roll, pitch and yaw are, to first order, its rotation vector. That is how the readers of g2o and
// GTSAM take the planar files, too. The vector part of a quaternion is half the rotation vector, so
// with S = diag(1, 1, 1, 2, 2, 2)
//     W_g2o = S W S.
// Taken over differences of the six coordinates themselves, W would turn with the measurement's own
// rotation as well: a difference of second order for small angles.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

namespace sg {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

// Upper triangle, row by row, of a symmetric or an upper triangular N x N matrix.
template <int N>
constexpr int triangle = N*(N + 1) / 2;

// The upper triangular matrix whose N (N + 1) / 2 entries stand at the front of `rest`.
template <int N>
Eigen::Matrix<double, N, N> read_triangle(std::string_view& rest);

// " w11 w12 ...": the upper triangle, row by row.
template <int N>
void append_triangle(std::string& out, const Eigen::Matrix<double, N, N>& matrix);

// The symmetric matrix with this upper triangle.
template <int N>
Eigen::Matrix<double, N, N> symmetric(const Eigen::Matrix<double, N, N>& upper);

// S W S and its inverse S^-1 W S^-1.
Matrix6d to_quaternion_information(const Matrix6d& information);
Matrix6d to_euler_information(const Matrix6d& information);

// "x y z roll pitch yaw" at the front of `rest`, appended as " x y z qx qy qz qw".
void translate_euler_pose(std::string_view& rest, std::string& out);
// "x y z qx qy qz qw" at the front of `rest`, appended as " x y z roll pitch yaw".
void translate_quaternion_pose(std::string_view& rest, std::string& out);

}  // namespace sg
