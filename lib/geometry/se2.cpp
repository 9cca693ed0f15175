#include "lib/geometry/se2.h"

#include <cmath>
#include <numbers>

#include "lib/geometry/information.h"

namespace sg::geometry {
namespace {

constexpr double pi = std::numbers::pi;

// sin(a)/a and (1 - cos(a))/a.
struct Sinc {
  double sine;
  double versine;
};
Sinc sinc(double a) {
  if (std::abs(a) < 1e-4) return {1 - a * a / 6, a / 2 * (1 - a * a / 12)};
  return {std::sin(a) / a, (1 - std::cos(a)) / a};
}

}  // namespace

double wrap(double angle) {
  if (angle > -pi && angle <= pi) return angle;
  const double wrapped = std::remainder(angle, 2 * pi);
  return wrapped <= -pi ? pi : wrapped;
}

SE2 compose(const SE2& a, const SE2& b) {
  const double c = std::cos(a.theta), s = std::sin(a.theta);
  return {a.x + c * b.x - s * b.y, a.y + s * b.x + c * b.y, wrap(a.theta + b.theta)};
}

SE2 inverse(const SE2& a) {
  const double c = std::cos(a.theta), s = std::sin(a.theta);
  return {-c * a.x - s * a.y, s * a.x - c * a.y, wrap(-a.theta)};
}

SE2 between(const SE2& a, const SE2& b) {
  const double c = std::cos(a.theta), s = std::sin(a.theta);
  const double dx = b.x - a.x, dy = b.y - a.y;
  return {c * dx + s * dy, -s * dx + c * dy, wrap(b.theta - a.theta)};
}

Eigen::Matrix2d rotation(double theta) {
  const double c = std::cos(theta), s = std::sin(theta);
  return Eigen::Matrix2d{{c, -s}, {s, c}};
}

Eigen::Vector2d act(const SE2& a, const Eigen::Vector2d& point) {
  return rotation(a.theta) * point + Eigen::Vector2d(a.x, a.y);
}

Eigen::Matrix3d adjoint(const SE2& a) {
  const double c = std::cos(a.theta), s = std::sin(a.theta);
  return Eigen::Matrix3d{{c, -s, a.y}, {s, c, -a.x}, {0, 0, 1}};
}

SE2 exp(const Eigen::Vector3d& v) {
  const auto [sine, versine] = sinc(v[2]);
  return {sine * v[0] - versine * v[1], versine * v[0] + sine * v[1], wrap(v[2])};
}

Eigen::Vector3d log(const SE2& a) {
  const auto [sine, versine] = sinc(a.theta);
  const double square = sine * sine + versine * versine;
  return {(sine * a.x + versine * a.y) / square, (sine * a.y - versine * a.x) / square, a.theta};
}

UncertainSE2 compose(const UncertainSE2& a, const UncertainSE2& b) {
  const Eigen::Matrix3d back = adjoint(b.mean);  // inverse of Ad(b^-1)
  const Eigen::Matrix3d moved = back.transpose() * a.information * back;
  return {compose(a.mean, b.mean), parallel_sum(moved, b.information)};
}

UncertainSE2 inverse(const UncertainSE2& a) {
  const SE2 mean = inverse(a.mean);
  const Eigen::Matrix3d back = adjoint(mean);
  return {mean, back.transpose() * a.information * back};
}

}  // namespace sg::geometry
