#include "lib/score/trajectory.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "lib/factor/initialize.h"
#include "lib/geometry/numbers.h"
#include "lib/text/error.h"

namespace sg::score {

std::optional<SE3> pose_of(graph::Space space, const std::vector<double>& numbers) {
  if (space == graph::Space::se2) return geometry::in_space(geometry::se2(numbers.data()));
  if (graph::has_quaternion(space)) return normalized(geometry::se3(numbers.data()));
  return {};
}

namespace {

SE3 pose_of(const Graph& graph, Index v, const std::vector<double>& n) {
  if (!std::ranges::all_of(n, [](double x) { return std::isfinite(x); }))
    throw graph::error_at(graph, graph.vertex_line[v], "a number is not finite");
  if (const auto pose = score::pose_of(graph.type_of_vertex(v).space, n)) return *pose;
  throw graph::error_at(graph, graph.vertex_line[v],
                        graph.type_of_vertex(v).tag + " is no pose that a trajectory can have");
}

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

// Of those of the pairs' poses that `which` picks.
Eigen::Matrix3Xd positions(const Trajectory& trajectory, const Pairs& pairs,
                           std::size_t Pairs::value_type::*which) {
  Eigen::Matrix3Xd result(3, pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i)
    result.col(static_cast<Eigen::Index>(i)) = trajectory.pose[pairs[i].*which].t;
  return result;
}

struct Similarity {
  double scale = 1;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

// The one that takes the first positions to the second. A single place has no scale.
Similarity fit(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to, bool scale) {
  const bool spread = (from.colwise() - from.rowwise().mean().eval()).norm() > 0;
  const bool planar = from.row(2).isZero(0) && to.row(2).isZero(0);
  const Eigen::Index d = planar ? 2 : 3;
  const Eigen::MatrixXd fitted = Eigen::umeyama(Eigen::MatrixXd(from.topRows(d)),
                                                Eigen::MatrixXd(to.topRows(d)), scale && spread);
  Similarity result;
  result.scale = fitted.col(0).head(d).norm();
  result.rotation.topLeftCorner(d, d) = fitted.topLeftCorner(d, d) / result.scale;
  result.translation.head(d) = fitted.col(d).head(d);
  return result;
}

void align(std::vector<SE3>& poses, const Similarity& to) {
  const Eigen::Quaterniond rotation(to.rotation);
  for (SE3& pose : poses) {
    pose.t = (to.scale * (to.rotation * pose.t) + to.translation).eval();
    pose.q = rotation * pose.q;
  }
}

double root_mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace

Trajectory trajectory(const Graph& graph) {
  Trajectory result;
  std::vector<double> numbers;
  std::optional<factor::Problem> problem;
  factor::Values values;
  if (graph.edges_only) {
    problem = factor::make_problem(graph);
    values = factor::initial_values(*problem);
  }
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (graph.role(v) != graph::Role::pose) continue;
    if (problem) {
      numbers = factor::estimate_numbers(*problem, values, v);
    } else {
      graph::vertex_numbers(graph, v, numbers);
    }
    result.id.push_back(graph.id[v]);
    result.pose.push_back(pose_of(graph, v, numbers));
  }
  return result;
}

bool is_planar(const Trajectory& trajectory) {
  return std::ranges::all_of(trajectory.pose, [](const SE3& pose) {
    return pose.t.z() == 0 && pose.q.x() == 0 && pose.q.y() == 0;
  });
}

std::optional<Alignment> alignment(std::string_view name) {
  if (name == "none") return Alignment::none;
  if (name == "se") return Alignment::se;
  if (name == "sim") return Alignment::sim;
  return std::nullopt;
}

Pairs matched(const Trajectory& a, const Trajectory& b) {
  Pairs result;
  std::size_t j = 0;
  for (std::size_t i = 0; i < a.id.size(); ++i) {
    while (j < b.id.size() && b.id[j] < a.id[i]) ++j;
    if (j < b.id.size() && b.id[j] == a.id[i]) result.emplace_back(i, j);
  }
  return result;
}

Trajectory aligned(Trajectory estimate, const Trajectory& reference, Alignment kind) {
  const Pairs pairs = matched(estimate, reference);
  if (pairs.empty() || kind == Alignment::none) return estimate;
  align(estimate.pose,
        fit(positions(estimate, pairs, &Pairs::value_type::first),
            positions(reference, pairs, &Pairs::value_type::second), kind == Alignment::sim));
  return estimate;
}

TrajectoryError trajectory_error(const Trajectory& estimate, const Trajectory& reference,
                                 Alignment kind) {
  const Pairs pairs = matched(estimate, reference);
  TrajectoryError result{pairs.size(), {}, {}};
  if (pairs.empty()) return result;
  const Trajectory moved = aligned(estimate, reference, kind);
  std::vector<double> absolute, relative;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const SE3 &own = moved.pose[pairs[k].first], &other = reference.pose[pairs[k].second];
    absolute.push_back((own.t - other.t).norm());
    if (k == 0) continue;
    const SE3 step = between(moved.pose[pairs[k - 1].first], own);
    relative.push_back(between(between(reference.pose[pairs[k - 1].second], other), step).t.norm());
  }
  result.ate = root_mean_square(absolute);
  if (!relative.empty()) result.rpe = root_mean_square(relative);
  return result;
}

}  // namespace sg::score
