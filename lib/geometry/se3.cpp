#include "lib/geometry/se3.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/geometry/information.h"

namespace sg::geometry {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double small =
    1e-2;  // below it power series are as exact as the closed forms, and do not cancel

// The left Jacobian of SO(3): V(w) with exp(u, w) = (V(w) u, exp(w)). Barfoot 7.37.
Matrix3d left_jacobian_so3(const Vector3d& w) {
  const double a2 = w.squaredNorm(), a = std::sqrt(a2);
  const double first = a < small ? 0.5 - a2 / 24 + a2 * a2 / 720 : (1 - std::cos(a)) / a2;
  const double second =
      a < small ? 1.0 / 6 - a2 / 120 + a2 * a2 / 5040 : (a - std::sin(a)) / (a2 * a);
  const Matrix3d W = skew(w);
  return Matrix3d::Identity() + first * W + second * W * W;
}

// The lower-left coupling of translation and rotation in the left Jacobian of SE(3). Barfoot 7.86b.
Matrix3d coupling(const Vector3d& u, const Vector3d& w) {
  const double a2 = w.squaredNorm(), a = std::sqrt(a2), a4 = a2 * a2;
  const bool series = a < small;
  const double c1 = series ? 1.0 / 6 - a2 / 120 + a4 / 5040 : (a - std::sin(a)) / (a2 * a);
  const double c2 = series ? 1.0 / 24 - a2 / 720 + a4 / 40320 : (a2 / 2 + std::cos(a) - 1) / a4;
  const double c3 = series ? 1.0 / 120 - a2 / 2520 + a4 / 120960
                           : (a - 1.5 * std::sin(a) + a / 2 * std::cos(a)) / (a4 * a);
  const Matrix3d U = skew(u), W = skew(w);
  const Matrix3d WU = W * U, UW = U * W, WUW = WU * W;
  return U / 2 + c1 * (WU + UW + WUW) + c2 * (W * WU + UW * W - 3 * WUW) + c3 * (WUW * W + W * WUW);
}

// A(a) = S^-1 Ad(a) S for errors whose rotation is a quaternion's vector part.
Matrix6d quaternion_adjoint(const SE3& a) {
  Matrix6d result = adjoint(a);
  result.topRightCorner<3, 3>() *= 2;
  return result;
}

}  // namespace

SE3 compose(const SE3& a, const SE3& b) {
  return {a.q * b.q, a.q * b.t + a.t};
}

SE3 inverse(const SE3& a) {
  const Quaterniond q = a.q.conjugate();
  return {q, q * -a.t};
}

SE3 between(const SE3& a, const SE3& b) {
  const Quaterniond q = a.q.conjugate();
  return {q * b.q, q * (b.t - a.t)};
}

SE3 normalized(SE3 a) {
  a.q.normalize();
  return a;
}

Vector3d act(const SE3& a, const Vector3d& point) {
  return a.q * point + a.t;
}

Matrix3d skew(const Vector3d& v) {
  return Matrix3d{{0, -v[2], v[1]}, {v[2], 0, -v[0]}, {-v[1], v[0], 0}};
}

Matrix6d adjoint(const SE3& a) {
  const Matrix3d R = a.q.toRotationMatrix();
  Matrix6d result;
  result << R, skew(a.t) * R, Matrix3d::Zero(), R;
  return result;
}

Quaterniond exp_so3(const Vector3d& w) {
  const double half2 = w.squaredNorm() / 4, half = std::sqrt(half2);
  const double scale =
      half < small ? 0.5 * (1 - half2 / 6 + half2 * half2 / 120) : 0.5 * std::sin(half) / half;
  Quaterniond q;
  q.w() = std::cos(half);
  q.vec() = scale * w;
  return q;
}

Vector3d log_so3(const Quaterniond& q) {
  const double sine = q.vec().norm(), sign = q.w() < 0 ? -1 : 1;
  const double cosine = sign * q.w();
  if (sine < 1e-8) return 2 * sign * q.vec();
  return 2 * sign * std::atan2(sine, cosine) / sine * q.vec();
}

SE3 exp(const Vector6d& v) {
  const Vector3d w = v.tail<3>();
  return {exp_so3(w), left_jacobian_so3(w) * v.head<3>()};
}

Vector6d log(const SE3& a) {
  const Vector3d w = log_so3(a.q);
  Vector6d v;
  v << inverse_left_jacobian_so3(w) * a.t, w;
  return v;
}

Vector6d compact(const SE3& a) {
  Vector6d v;
  v << a.t, (a.q.w() < 0 ? -1 : 1) * a.q.vec();
  return v;
}

SE3 from_compact(const Vector6d& v) {
  const double square = v.tail<3>().squaredNorm();
  const SE3 a{Quaterniond(std::sqrt(std::max(0.0, 1 - square)), v[3], v[4], v[5]), v.head<3>()};
  return square > 1 ? normalized(a) : a;
}

Vector6d swapped(const Vector6d& v) {
  Vector6d result;
  result << v.tail<3>(), v.head<3>();
  return result;
}

Matrix6d swapped(const Matrix6d& m) {
  Matrix6d result;
  result << m.bottomRightCorner<3, 3>(), m.bottomLeftCorner<3, 3>(), m.topRightCorner<3, 3>(),
      m.topLeftCorner<3, 3>();
  return result;
}

Matrix3d inverse_left_jacobian_so3(const Vector3d& w) {
  const double a2 = w.squaredNorm(), a = std::sqrt(a2);
  const double second = a < small ? 1.0 / 12 + a2 / 720 + a2 * a2 / 30240
                                  : (1 - a / 2 * std::sin(a) / (1 - std::cos(a))) / a2;
  const Matrix3d W = skew(w);
  return Matrix3d::Identity() - W / 2 + second * W * W;
}

Matrix6d inverse_left_jacobian(const Vector6d& v) {
  const Matrix3d inverse = inverse_left_jacobian_so3(v.tail<3>());
  Matrix6d result;
  result << inverse, -inverse * coupling(v.head<3>(), v.tail<3>()) * inverse, Matrix3d::Zero(),
      inverse;
  return result;
}

Quaterniond from_roll_pitch_yaw(double roll, double pitch, double yaw) {
  using Eigen::AngleAxisd;
  return AngleAxisd(yaw, Vector3d::UnitZ()) * AngleAxisd(pitch, Vector3d::UnitY()) *
         AngleAxisd(roll, Vector3d::UnitX());
}

Vector3d roll_pitch_yaw(const Quaterniond& q) {
  const Matrix3d R = q.toRotationMatrix();
  const double pitch = std::atan2(-R(2, 0), std::hypot(R(2, 1), R(2, 2)));
  const double yaw = std::atan2(R(1, 0), R(0, 0)), c = std::cos(yaw), s = std::sin(yaw);
  return {std::atan2(s * R(0, 2) - c * R(1, 2), c * R(1, 1) - s * R(0, 1)), pitch, yaw};
}

UncertainSE3 compose(const UncertainSE3& a, const UncertainSE3& b) {
  const Matrix6d back = quaternion_adjoint(b.mean);  // inverse of A(b^-1)
  const Matrix6d moved = back.transpose() * a.information * back;
  return {compose(a.mean, b.mean), parallel_sum(moved, b.information)};
}

UncertainSE3 inverse(const UncertainSE3& a) {
  const SE3 mean = inverse(a.mean);
  const Matrix6d back = quaternion_adjoint(mean);
  return {mean, back.transpose() * a.information * back};
}

}  // namespace sg::geometry
