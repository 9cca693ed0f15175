#include "lib/factor/motion.h"

#include <array>
#include <cmath>

#include "lib/geometry/numbers.h"

namespace sg::factor {
namespace {

// Body to world.
SE3 pose(graph::Space space, const double* x) {
  switch (space) {
    case graph::Space::se2:
      return geometry::in_space(geometry::se2(x));
    case graph::Space::expmap:
    case graph::Space::bal_camera:
      return inverse(geometry::se3(x));
    case graph::Space::xy:
      return {Eigen::Quaterniond::Identity(), {x[0], x[1], 0}};
    case graph::Space::xyz:
      return {Eigen::Quaterniond::Identity(), geometry::vector3(x)};
    default:
      return geometry::se3(x);
  }
}

SE3 pose(const Problem& problem, const Values& values, Index v) {
  return pose(problem.space[v], values.data() + problem.value_at[v]);
}

// How fast the error grows with a step along these axes, squared, on average.
double information_of(const Model& model, const graph::Axes& axes, const Whitening& U) {
  double sum = 0;
  for (int k = axes.first * model.dim; k < (axes.first + axes.size) * model.dim; ++k)
    sum += U.U[k] * U.U[k];
  return axes.size > 0 && std::isfinite(sum) ? sum / axes.size : 0;
}

}  // namespace

std::optional<Motion> measured_motion(const Problem& problem, Index e) {
  const Model& model = *problem.model[e];
  const graph::SpaceRow& facts = graph::facts(graph::row(model.type).measure.space);
  if (facts.translation.size == 0 || !model.place) return {};
  // Where the last end stands if the other is at the origin.
  const int last = model.arity - 1;
  std::array<double, max_step + 1> origin{}, seen{};
  set_origin(model.ends[0], origin.data());
  const std::array<const double*, max_ends> x{origin.data(), origin.data()};
  if (!model.place(x.data(), constants_of(problem, e), last, seen.data())) return {};
  const SE3 motion = pose(model.ends[last], seen.data());
  const Whitening U = whitening_of(problem, e);
  return Motion{motion.q.toRotationMatrix(), motion.t,
                information_of(model, facts.rotation, U) * facts.radian * facts.radian,
                information_of(model, facts.translation, U)};
}

Eigen::Matrix3d rotation(const Problem& problem, const Values& values, Index v) {
  return pose(problem, values, v).q.toRotationMatrix();
}

Eigen::Vector3d translation(const Problem& problem, const Values& values, Index v) {
  return pose(problem, values, v).t;
}

void set_rotation(const Problem& problem, Index v, const Eigen::Matrix3d& R, Values& values) {
  const graph::Space space = problem.space[v];
  double* const x = values.data() + problem.value_at[v];
  if (space == graph::Space::se2) {
    x[2] = std::atan2(R(1, 0), R(0, 0));
    return;
  }
  const SE3 turned{Eigen::Quaterniond(R).normalized(), pose(space, x).t};
  set_se3(space == graph::Space::se3 ? turned : inverse(turned), x);
}

}  // namespace sg::factor
