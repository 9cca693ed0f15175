#include "lib/prune/motion.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/factor/whitening.h"
#include "lib/geometry/information.h"
#include "lib/geometry/numbers.h"
#include "lib/geometry/triangle.h"
#include "lib/text/error.h"
#include "lib/text/words.h"

namespace sg::prune {
namespace {

using Eigen::Matrix3d;

// z^-1 x as the error vector of the type, and its derivative by a small motion d of x: x -> x d.
struct Residual2 {
  Eigen::Vector3d error;
  Matrix3d jacobian;
};
Residual2 residual(const SE2& z, const SE2& x) {
  const SE2 e = between(z, x);
  Matrix3d jacobian = Matrix3d::Identity();
  jacobian.topLeftCorner<2, 2>() = geometry::rotation(e.theta);
  return {{e.x, e.y, e.theta}, jacobian};
}

struct Residual3 {
  Vector6d error;
  Matrix6d jacobian;
};
Residual3 residual(const SE3& z, const SE3& x) {
  SE3 e = between(z, x);
  if (e.q.w() < 0) e.q.coeffs() *= -1;
  Residual3 result{Vector6d::Zero(), Matrix6d::Zero()};
  result.error = compact(e);
  result.jacobian.topLeftCorner<3, 3>() = e.q.toRotationMatrix();
  result.jacobian.bottomRightCorner<3, 3>() =
      e.q.w() * Matrix3d::Identity() + geometry::skew(e.q.vec());
  return result;
}

// The step of Gauss-Newton in (translation, quaternion's vector part) as a motion.
SE2 small_motion(const Eigen::Vector3d& d) {
  return {d[0], d[1], geometry::wrap(d[2])};
}
SE3 small_motion(const Vector6d& d) {
  return normalized(geometry::from_compact(d));
}

constexpr int fusion_steps = 10;
constexpr double fusion_tolerance = 1e-12;

// Gauss-Newton from the first measurement on. Directions without information keep its value.
template <class Uncertain>
Uncertain fuse_local(const std::vector<Motion>& motions) {
  Uncertain result = std::get<Uncertain>(motions[0]);
  for (int step = 0; step < fusion_steps; ++step) {
    auto gradient = residual(result.mean, result.mean).error;
    result.information.setZero();
    for (const Motion& m : motions) {
      const auto& z = std::get<Uncertain>(m);
      const auto [error, jacobian] = residual(z.mean, result.mean);
      gradient += jacobian.transpose() * z.information * error;
      result.information += jacobian.transpose() * z.information * jacobian;
    }
    const decltype(gradient) change = -geometry::least_norm_solution(result.information, gradient);
    result.mean = geometry::compose(result.mean, small_motion(change));
    if (change.norm() < fusion_tolerance) break;
  }
  return result;
}

// The error e of C = z^-1 is, in the world frame, log(X1 x z^-1 X1^-1); the unknown moves by x ->
// X1^-1 exp(d) X1 x.
ExpmapMotion fuse_world(const std::vector<Motion>& motions, const SE3& first_pose) {
  ExpmapMotion result = std::get<ExpmapMotion>(motions[0]);
  const Matrix6d to_world = adjoint(first_pose), from_world = adjoint(inverse(first_pose));
  for (int step = 0; step < fusion_steps; ++step) {
    Vector6d gradient = Vector6d::Zero();
    Matrix6d information = Matrix6d::Zero();
    for (const Motion& m : motions) {
      const auto& z = std::get<ExpmapMotion>(m);
      const Vector6d error = to_world * log(compose(result.mean, inverse(z.mean)));
      const Matrix6d jacobian = geometry::inverse_left_jacobian(error),
                     weight = geometry::swapped(z.information);
      gradient += jacobian.transpose() * weight * error;
      information += jacobian.transpose() * weight * jacobian;
    }
    const Vector6d change = -geometry::least_norm_solution(information, gradient);
    result.mean = compose(geometry::exp(Vector6d(from_world * change)), result.mean);
    result.information = geometry::swapped(information);
    if (change.norm() < fusion_tolerance) break;
  }
  return result;
}

template <class Measured>
std::string edge_text(graph::EdgeTag type, const Measured& z, Id first, Id second) {
  std::string text(graph::name(type));
  text::append_number(text, first);
  text::append_number(text, second);
  text::append_numbers(text, geometry::numbers_of(z.mean));
  text::append_numbers(text, geometry::upper_triangle(z.information));
  return text;
}

}  // namespace

bool is_motion(graph::EdgeTag type) {
  return type == graph::EdgeTag::se2 || type == graph::EdgeTag::se3 ||
         type == graph::EdgeTag::expmap;
}

namespace {

// What no solver takes is not composed either: it would become an edge that looks sound.
void expect_sound(const Graph& graph, Index e, std::span<const double> numbers,
                  std::size_t measurement, int dim) {
  const auto fail = [&](const char* cause) {
    throw graph::error_at(graph, graph.edge_line[e], cause);
  };
  if (!std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); }))
    fail("a number is not finite");
  std::array<double, 36> root;
  if (!factor::whitening(numbers.subspan(measurement), dim, root.data()))
    fail("the information matrix is not positive semidefinite");
}

}  // namespace

std::optional<Motion> motion(const Graph& graph, Index e) {
  const graph::EdgeTag type = graph.edge_tag(e);
  if (!is_motion(type)) return std::nullopt;
  thread_local std::vector<double> n;
  graph::edge_numbers(graph, e, n);
  const bool planar = type == graph::EdgeTag::se2;
  expect_sound(graph, e, n, planar ? 3 : 7, planar ? 3 : 6);
  if (planar)
    return geometry::UncertainSE2{geometry::se2(n.data()),
                                  geometry::symmetric<Matrix3d>(std::span(n).subspan(3))};
  const SE3 mean = normalized(geometry::se3(n.data()));
  const Matrix6d information = geometry::symmetric<Matrix6d>(std::span(n).subspan(7));
  if (type == graph::EdgeTag::se3) return geometry::UncertainSE3{mean, information};
  return ExpmapMotion{mean, information};
}

Motion compose(const Motion& first, const Motion& second) {
  if (const auto* a = std::get_if<geometry::UncertainSE2>(&first))
    return compose(*a, std::get<geometry::UncertainSE2>(second));
  if (const auto* a = std::get_if<geometry::UncertainSE3>(&first))
    return compose(*a, std::get<geometry::UncertainSE3>(second));
  const auto& a = std::get<ExpmapMotion>(first);
  const auto& b = std::get<ExpmapMotion>(second);
  return ExpmapMotion{compose(a.mean, b.mean),
                      geometry::parallel_sum(a.information, b.information)};
}

Motion inverse(const Motion& motion) {
  if (const auto* a = std::get_if<geometry::UncertainSE2>(&motion)) return inverse(*a);
  if (const auto* a = std::get_if<geometry::UncertainSE3>(&motion)) return inverse(*a);
  const auto& a = std::get<ExpmapMotion>(motion);
  return ExpmapMotion{inverse(a.mean), a.information};
}

Motion fuse(const std::vector<Motion>& motions, const SE3& first_pose) {
  if (motions.size() == 1) return motions[0];
  if (std::holds_alternative<geometry::UncertainSE2>(motions[0]))
    return fuse_local<geometry::UncertainSE2>(motions);
  if (std::holds_alternative<geometry::UncertainSE3>(motions[0]))
    return fuse_local<geometry::UncertainSE3>(motions);
  return fuse_world(motions, first_pose);
}

SE3 mean(const Motion& motion) {
  if (const auto* a = std::get_if<geometry::UncertainSE2>(&motion))
    return geometry::in_space(a->mean);
  if (const auto* a = std::get_if<geometry::UncertainSE3>(&motion)) return a->mean;
  return std::get<ExpmapMotion>(motion).mean;
}

double distance(const Motion& motion) {
  if (const auto* a = std::get_if<geometry::UncertainSE2>(&motion))
    return std::hypot(a->mean.x, a->mean.y);
  if (const auto* a = std::get_if<geometry::UncertainSE3>(&motion)) return a->mean.t.norm();
  return std::get<ExpmapMotion>(motion).mean.t.norm();
}

double angle(const Motion& motion) {
  if (const auto* a = std::get_if<geometry::UncertainSE2>(&motion))
    return std::abs(geometry::wrap(a->mean.theta));
  if (const auto* a = std::get_if<geometry::UncertainSE3>(&motion))
    return geometry::log_so3(a->mean.q).norm();
  return geometry::log_so3(std::get<ExpmapMotion>(motion).mean.q).norm();
}

std::string edge_text(const Motion& motion, Id first, Id second) {
  if (const auto* a = std::get_if<geometry::UncertainSE2>(&motion))
    return edge_text(graph::EdgeTag::se2, *a, first, second);
  if (const auto* a = std::get_if<geometry::UncertainSE3>(&motion))
    return edge_text(graph::EdgeTag::se3, *a, first, second);
  return edge_text(graph::EdgeTag::expmap, std::get<ExpmapMotion>(motion), first, second);
}

}  // namespace sg::prune
