#include "lib/factor/plausible.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

#include "lib/factor/initialize.h"
#include "lib/factor/linearize.h"
#include "lib/geometry/numbers.h"
#include "lib/geometry/se3.h"
#include "lib/geometry/triangle.h"
#include "lib/graph/replay.h"
#include "lib/text/error.h"

namespace sg::factor {
namespace {

using graph::Severity;

// ---- Landmarks

constexpr int largest_landmark = 4;  // dimensions
using Information =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, largest_landmark, largest_landmark>;

// The sum of J' W J over the observations of every variable that is a landmark; empty of others, and of those with an
// observation that has no derivative.
std::vector<Information> landmark_information(const Problem& problem, const Values& values) {
  const Graph& graph = *problem.graph;
  const graph::Pattern& pattern = problem.variables.pattern;
  std::vector<Information> sums(pattern.dim.size());
  const auto is_landmark = [&](Index variable) {
    const Index v = problem.variables.variable_vertex[variable];
    return graph.role(v) == graph::Role::landmark && graph.dim(v) <= largest_landmark;
  };
  std::vector<bool> undefined(sums.size(), false);
  std::vector<double> numbers;
  for (Index e = 0; e < graph.edges(); ++e) {
    const auto row = pattern.rows[e];
    if (std::ranges::none_of(row, is_landmark)) continue;
    const int height = block_rows(problem, e);
    numbers.assign(static_cast<std::size_t>(height) * block_columns(pattern, e), 0);
    linearize_row(problem, values, {}, e, numbers.data());
    const Eigen::Map<const Eigen::MatrixXd> block(numbers.data(), height,
                                                  block_columns(pattern, e));
    int at = 0;
    for (const Index variable : row) {
      const auto columns = block.middleCols(at, pattern.dim[variable]);
      at += pattern.dim[variable];
      if (!is_landmark(variable)) continue;
      if (sums[variable].size() == 0) sums[variable].setZero(columns.cols(), columns.cols());
      sums[variable] += columns.transpose() * columns;
      if (!columns.allFinite()) undefined[variable] = true;
    }
  }
  for (std::size_t k = 0; k < sums.size(); ++k) {
    if (undefined[k]) sums[k].resize(0, 0);
  }
  return sums;
}

void check_landmarks(const Problem& problem, const Values& values, graph::Findings& findings) {
  const Graph& graph = *problem.graph;
  const std::vector<Information> sums = landmark_information(problem, values);
  for (std::size_t k = 0; k < sums.size(); ++k) {
    if (sums[k].size() == 0) continue;
    const Eigen::SelfAdjointEigenSolver<Information> spectrum(sums[k], Eigen::EigenvaluesOnly);
    const double least = spectrum.eigenvalues()[0], most = spectrum.eigenvalues().reverse()[0];
    if (!(least < 1e-10 * most)) continue;
    const Index v = problem.variables.variable_vertex[k];
    findings.push_back(
        {graph.vertex_line[v], least < 1e-14 * most ? Severity::error : Severity::warning,
         "vertex " + std::to_string(graph.id[v]) + " (" + graph.type_of_vertex(v).tag +
             ") is not determined where it stands: its observations agree along a line"});
  }
}

// ---- Scales

void check_scales(const Problem& problem, graph::Findings& findings) {
  struct Extremes {
    double least, most;
    Index of_least, of_most;
  };
  const Graph& graph = *problem.graph;
  std::map<graph::TypeIndex, Extremes> types;
  for (Index e = 0; e < graph.edges(); ++e) {
    const int dim = dim_of(problem, e);
    const double* const U = problem.whitening.data() + problem.whitening_at[e];
    const double scale = Eigen::Map<const Eigen::MatrixXd>(U, dim, dim).squaredNorm() / dim;
    if (!(scale > 0)) continue;
    auto& found = types.try_emplace(graph.edge_type[e], Extremes{scale, scale, e, e}).first->second;
    if (scale < found.least) found.least = scale, found.of_least = e;
    if (scale > found.most) found.most = scale, found.of_most = e;
  }
  for (const auto& [type, found] : types) {
    if (!(found.most > 1e12 * found.least)) continue;
    const int decades =
        static_cast<int>(std::floor(std::log10(found.most) - std::log10(found.least)));
    findings.push_back(
        {graph.edge_line[found.of_most], Severity::warning,
         "the information of this " + graph.tags.edges[type].tag + " is 10^" +
             std::to_string(decades) + " times that of line " +
             std::to_string(graph::line_number(graph, graph.edge_line[found.of_least])) +
             ": solvers lose their digits"});
  }
}

// ---- Closures

constexpr int beyond_reason =
    6;  // standard deviations; sound graphs, real and generated, stay below 4

// A measured motion between poses with how well it is known: variances of a translation and a rotation, all axes summed.
struct Step {
  SE3 motion;
  double translation, rotation;
};

template <int N>
std::optional<Step> step_of(const SE3& motion, std::span<const double> triangle,
                            const graph::SpaceRow& space) {
  const auto W = geometry::symmetric<Eigen::Matrix<double, N, N>>(triangle);
  const Eigen::LLT<Eigen::Matrix<double, N, N>> cholesky(W);
  if (cholesky.info() != Eigen::Success) return std::nullopt;  // not known at all in some direction
  const Eigen::Matrix<double, N, 1> variance =
      cholesky.solve(Eigen::Matrix<double, N, N>::Identity()).diagonal();
  const auto sum = [&](graph::Axes axes) { return variance.segment(axes.first, axes.size).sum(); };
  return Step{motion, sum(space.translation), sum(space.rotation) / (space.radian * space.radian)};
}

// Of edges whose error stands in the measurement's own frame.
std::optional<Step> step_of(const Graph& graph, Index e, std::vector<double>& n) {
  const graph::EdgeTag type = graph.edge_tag(e);
  if (type != graph::EdgeTag::se2 && type != graph::EdgeTag::se3) return std::nullopt;
  graph::edge_numbers(graph, e, n);
  const graph::SpaceRow& space = graph::facts(graph.type_of_edge(e).space);
  if (type == graph::EdgeTag::se2)
    return step_of<3>(geometry::in_space(geometry::se2(n.data())), {n.data() + 3, 6}, space);
  return step_of<6>(geometry::normalized(geometry::se3(n.data())), {n.data() + 7, 21}, space);
}

// Odometry composed from the first pose of a segment, and the sums that give the variance between any two poses of it:
// a rotation of step s moves pose j by its distance |p_j - p_s|, squared and summed as |p_j|^2 B - 2 p_j' C + D.
struct Composed {
  SE3 pose;
  Index segment = 0;
  double length = 0;
  double A = 0, B = 0, D = 0;
  Eigen::Vector3d C = Eigen::Vector3d::Zero();
};

std::vector<Composed> compose_odometry(const Graph& graph, const graph::PoseIndex& poses) {
  std::vector<std::optional<Step>> step(
      poses.pose.size());  // to pose k from the one before; the first such edge
  std::vector<double> numbers;
  for (Index e = 0; e < graph.edges(); ++e) {
    if (graph::edge_role(graph, poses, e) != graph::EdgeRole::odometry) continue;
    const auto ends = graph.edge(e);
    const Index a = poses.index[ends[0]], b = poses.index[ends[1]];
    if (step[std::max(a, b)]) continue;
    auto found = step_of(graph, e, numbers);
    if (found && a > b) found->motion = inverse(found->motion);
    step[std::max(a, b)] = found;
  }
  std::vector<Composed> composed(poses.pose.size());
  for (std::size_t k = 1; k < composed.size(); ++k) {
    const Composed& before = composed[k - 1];
    Composed& now = composed[k];
    if (!step[k]) {
      now.segment = before.segment + 1;
      continue;
    }
    const Eigen::Vector3d& at = before.pose.t;
    now = before;
    now.pose = compose(before.pose, step[k]->motion);
    now.length += step[k]->motion.t.norm();
    now.A += step[k]->translation;
    now.B += step[k]->rotation;
    now.C += step[k]->rotation * at;
    now.D += step[k]->rotation * at.squaredNorm();
  }
  return composed;
}

// How far the composed odometry ends from where the closure says, in standard deviations.
double composed_miss(const Composed& a, const Composed& b, const Step& closure) {
  const Eigen::Vector3d& p = b.pose.t;
  const double variance = b.A - a.A + p.squaredNorm() * (b.B - a.B) - 2 * p.dot(b.C - a.C) + b.D -
                          a.D + closure.translation;
  const double deviation = std::sqrt(std::max(variance, closure.translation));
  return (act(a.pose, closure.motion.t) - p).norm() / deviation;
}

// How much farther apart the closure sees the poses than the whole way between is long, whatever its turns.
double length_miss(const Composed& a, const Composed& b, const Step& closure) {
  return (closure.motion.t.norm() - (b.length - a.length)) /
         std::sqrt(b.A - a.A + closure.translation);
}

void check_closures(const Graph& graph, graph::Findings& findings) {
  const graph::PoseIndex poses = graph::pose_index(graph);
  const std::vector<Composed> composed = compose_odometry(graph, poses);
  std::vector<double> numbers;
  Offset line = graph::implied;
  double worst = 0;
  Index count = 0;
  for (Index e = 0; e < graph.edges(); ++e) {
    if (graph::edge_role(graph, poses, e) != graph::EdgeRole::loop_closure) continue;
    auto closure = step_of(graph, e, numbers);
    if (!closure) continue;
    Index i = poses.index[graph.edge(e)[0]], j = poses.index[graph.edge(e)[1]];
    if (i > j) {
      closure->motion = inverse(closure->motion);
      std::swap(i, j);
    }
    const Composed &a = composed[i], &b = composed[j];
    if (a.segment != b.segment) continue;
    const double miss = std::max(composed_miss(a, b, *closure), length_miss(a, b, *closure));
    if (!(miss > beyond_reason)) continue;
    ++count;
    if (miss > worst) worst = miss, line = graph.edge_line[e];
  }
  if (count == 0) return;
  findings.push_back({line, Severity::warning,
                      "the odometry between disagrees with this loop closure by " +
                          std::to_string(static_cast<std::int64_t>(std::min(worst, 1e15))) +
                          " standard deviations" +
                          (count > 1 ? ", and with " + std::to_string(count - 1) +
                                           " more by over " + std::to_string(beyond_reason)
                                     : "") +
                          ": one of them, or its information, is wrong"});
}

}  // namespace

graph::Findings check_plausible(const Graph& graph) {
  graph::Findings findings;
  try {
    const Problem problem = make_problem(graph);
    check_landmarks(problem, start_values(problem), findings);
    check_scales(problem, findings);
    check_closures(graph, findings);
  } catch (const text::Error&) {
    // Said by who reads lines, or of no concern where only the structure counts.
  }
  return findings;
}

}  // namespace sg::factor
