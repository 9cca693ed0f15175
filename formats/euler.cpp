#include "formats/euler.h"

namespace sg::formats {
namespace {

Matrix6d scaled(const Matrix6d& information, double rotation) {
  Vector6d s = Vector6d::Ones();
  s.tail<3>().setConstant(rotation);
  return s.asDiagonal() * information * s.asDiagonal();
}

Eigen::Quaterniond read_quaternion(std::string_view& rest) {
  Eigen::Quaterniond q;
  for (double& number : q.coeffs()) number = text::read_number(rest);
  if (!(q.norm() > 0)) throw text::BadLine{"a quaternion has length zero"};
  return q.normalized();
}

}  // namespace

Matrix6d to_quaternion_information(const Matrix6d& information) {
  return scaled(information, 2);
}

Matrix6d to_euler_information(const Matrix6d& information) {
  return scaled(information, 0.5);
}

void translate_euler_pose(std::string_view& rest, std::string& out) {
  text::copy_numbers(rest, 3, out);
  const double roll = text::read_number(rest);
  const double pitch = text::read_number(rest);
  const double yaw = text::read_number(rest);
  const Eigen::Quaterniond q = geometry::from_roll_pitch_yaw(roll, pitch, yaw);
  for (const double number : q.coeffs()) text::append_number(out, number);
}

void copy_quaternion_pose(std::string_view& rest, std::string& out) {
  auto copy = rest;
  text::copy_numbers(rest, 7, out);
  for (int k = 0; k < 3; ++k) text::read_number(copy);
  read_quaternion(copy);
}

void translate_quaternion_pose(std::string_view& rest, std::string& out) {
  text::copy_numbers(rest, 3, out);
  for (const double angle : geometry::roll_pitch_yaw(read_quaternion(rest))) {
    text::append_number(out, angle + 0.0);  // no -0
  }
}

}  // namespace sg::formats
