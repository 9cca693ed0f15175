#include "formats/euler.h"

#include <Eigen/Geometry>
#include <cmath>

#include "formats/line.h"

namespace sg {
namespace {

// Near pitch = +-pi/2, where only roll -+ yaw is determined, atan2 still splits it so that the
// rotation is the same one.
Eigen::Vector3d roll_pitch_yaw(const Eigen::Quaterniond& q) {
  const Eigen::Matrix3d r = q.toRotationMatrix();
  const double pitch = std::atan2(-r(2, 0), std::hypot(r(2, 1), r(2, 2)));
  const double yaw = std::atan2(r(1, 0), r(0, 0));
  const double s = std::sin(yaw);
  const double c = std::cos(yaw);
  return {std::atan2(s * r(0, 2) - c * r(1, 2), c * r(1, 1) - s * r(0, 1)), pitch, yaw};
}

Matrix6d scaled(const Matrix6d& information, double rotation) {
  Eigen::Matrix<double, 6, 1> s = Eigen::Matrix<double, 6, 1>::Ones();
  s.tail<3>().setConstant(rotation);
  return s.asDiagonal() * information * s.asDiagonal();
}

}  // namespace

template <int N>
Eigen::Matrix<double, N, N> read_triangle(std::string_view& rest) {
  Eigen::Matrix<double, N, N> upper = Eigen::Matrix<double, N, N>::Zero();
  for (int i = 0; i < N; ++i) {
    for (int j = i; j < N; ++j) upper(i, j) = read_number(rest);
  }
  return upper;
}

template <int N>
void append_triangle(std::string& out, const Eigen::Matrix<double, N, N>& matrix) {
  for (int i = 0; i < N; ++i) {
    for (int j = i; j < N; ++j) append_number(out, matrix(i, j));
  }
}

template <int N>
Eigen::Matrix<double, N, N> symmetric(const Eigen::Matrix<double, N, N>& upper) {
  return upper.template selfadjointView<Eigen::Upper>();
}

template Eigen::Matrix2d read_triangle<2>(std::string_view&);
template Eigen::Matrix3d read_triangle<3>(std::string_view&);
template Matrix6d read_triangle<6>(std::string_view&);
template void append_triangle<2>(std::string&, const Eigen::Matrix2d&);
template void append_triangle<3>(std::string&, const Eigen::Matrix3d&);
template void append_triangle<6>(std::string&, const Matrix6d&);
template Eigen::Matrix2d symmetric<2>(const Eigen::Matrix2d&);
template Eigen::Matrix3d symmetric<3>(const Eigen::Matrix3d&);
template Matrix6d symmetric<6>(const Matrix6d&);

Matrix6d to_quaternion_information(const Matrix6d& information) {
  return scaled(information, 2);
}

Matrix6d to_euler_information(const Matrix6d& information) {
  return scaled(information, 0.5);
}

void translate_euler_pose(std::string_view& rest, std::string& out) {
  for (int k = 0; k < 3; ++k) append_word(out, read_number_text(rest));
  const double roll = read_number(rest);
  const double pitch = read_number(rest);
  const double yaw = read_number(rest);
  const Eigen::Quaterniond q = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                               Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                               Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX());
  for (const double value : {q.x(), q.y(), q.z(), q.w()}) append_number(out, value);
}

void translate_quaternion_pose(std::string_view& rest, std::string& out) {
  for (int k = 0; k < 3; ++k) append_word(out, read_number_text(rest));
  Eigen::Quaterniond q;
  for (const int k : {0, 1, 2, 3}) q.coeffs()[k] = read_number(rest);
  if (!(q.norm() > 0)) throw BadLine{"the quaternion is zero"};
  const Eigen::Vector3d angles = roll_pitch_yaw(q.normalized());
  for (const double angle : angles) append_number(out, angle + 0.0);  // no -0
}

}  // namespace sg
