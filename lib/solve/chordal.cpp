#include "lib/solve/chordal.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/factor/gauge.h"
#include "lib/factor/motion.h"
#include "lib/geometry/se2.h"
#include "lib/solve/least_squares.h"

namespace sg::solve {
namespace {

constexpr Index world = -1;

struct MotionEdge {
  Index i, j;  // i may be the world
  factor::Motion motion;
};

int dimensions(graph::Space space) {
  return graph::facts(space).translation.size;
}

// A problem of d dimensions: which rows of [R t] are unknown, and the system in them.
template <int d>
struct Relaxation {
  using Vector = Eigen::Matrix<double, d, 1>;
  using Rotation = Eigen::Matrix<double, d, d>;

  const factor::Problem& problem;
  factor::Values& values;
  std::vector<MotionEdge> edges;
  std::vector<Index> unknown;  // of every vertex, its variable: of a pose d numbers of R, then one
                               // of t; -1: it stays
  LeastSquares system;

  bool is_pose(Index v) const { return v != world && problem.graph->role(v) == graph::Role::pose; }
  bool stays(Index v) const { return v == world || unknown[v] < 0; }
  Rotation rotation(Index v) const {
    return factor::rotation(problem, values, v).template topLeftCorner<d, d>();
  }
  // Of the [R t] of what stays. What has no R counts as not turned.
  Vector known_column(Index v, int c) const {
    if (c < d) return is_pose(v) ? Vector(rotation(v).col(c)) : Vector(Vector::Unit(c));
    if (v == world) return Vector::Zero();
    return factor::translation(problem, values, v).template head<d>();
  }
};

// A x = B, of the d columns x of what is unknown.
template <int d>
struct Equations {
  Eigen::Matrix<double, d + 1, Eigen::Dynamic, 0, d + 1, 2 * (d + 1)> A;
  Eigen::Matrix<double, d + 1, d> B = Eigen::Matrix<double, d + 1, d>::Zero();
  int rows = 0;
};

// Adds to the last equation `factor` times column c of the [R t] of v, whose numbers are from this column of A on.
template <int d>
void add_column(const Relaxation<d>& relaxation, Index v, int column, int c, double factor,
                Equations<d>& equations) {
  const int row = equations.rows - 1;
  const bool turns = relaxation.is_pose(v);
  if (!relaxation.stays(v) && (turns || c == d)) {
    equations.A(row, column + (turns ? c : 0)) += factor;
  } else {
    equations.B.row(row) -= factor * relaxation.known_column(v, c);
  }
}

template <int d>
void add_edge(Relaxation<d>& relaxation, const MotionEdge& edge) {
  const auto& [i, j, motion] = edge;
  std::vector<Index> variables;
  int columns = 0;
  const auto take_in = [&](Index v) {
    const int first = columns;
    if (relaxation.stays(v)) return first;
    variables.push_back(relaxation.unknown[v]);
    columns += relaxation.is_pose(v) ? d + 1 : 1;
    return first;
  };
  const int of_i = take_in(i), of_j = take_in(j);
  if (variables.empty()) return;
  Equations<d> equations;
  equations.A.setZero(d + 1, columns);
  for (int a = 0; a < d && motion.turn_information > 0; ++a) {
    const double root = std::sqrt(motion.turn_information / 2);
    ++equations.rows;
    add_column(relaxation, j, of_j, a, root, equations);
    for (int c = 0; c < d; ++c)
      add_column(relaxation, i, of_i, c, -root * motion.R(c, a), equations);
  }
  if (motion.place_information > 0) {
    const double root = std::sqrt(motion.place_information);
    ++equations.rows;
    add_column(relaxation, j, of_j, d, root, equations);
    add_column(relaxation, i, of_i, d, -root, equations);
    for (int c = 0; c < d; ++c) add_column(relaxation, i, of_i, c, -root * motion.t[c], equations);
  }
  add_row(relaxation.system, variables, equations.A.topRows(equations.rows),
          equations.B.topRows(equations.rows));
}

// Those that say something; priors of places alone hold no rotation, and are for later.
std::vector<MotionEdge> motion_edges(const factor::Problem& problem, int d,
                                     std::vector<bool>& left_out) {
  const Graph& graph = *problem.graph;
  std::vector<MotionEdge> result;
  for (Index e = 0; e < graph.edges(); ++e) {
    const auto ends = graph.edge(e);
    const bool unary = ends.size() == 1;
    if (dimensions(problem.space[ends.back()]) != d || (!unary && ends[0] == ends[1])) continue;
    const auto motion = factor::measured_motion(problem, e);
    if (!motion || !(motion->turn_information > 0 || (motion->place_information > 0 && !unary)))
      continue;
    left_out[e] = false;
    result.push_back({unary ? world : ends[0], ends.back(), *motion});
  }
  return result;
}

template <int d>
Relaxation<d> make_relaxation(const factor::Problem& problem, factor::Values& values) {
  const Graph& graph = *problem.graph;
  std::vector<bool> left_out(graph.edges(), true);
  Relaxation<d> result{problem, values, motion_edges(problem, d, left_out), {}, {}};
  const std::vector<bool> stays = factor::anchors(problem, left_out);
  std::vector<int> dim;
  for (Index v = 0; v < graph.vertices(); ++v) {
    const bool known = stays[v] || dimensions(problem.space[v]) != d;
    result.unknown.push_back(known ? -1 : static_cast<Index>(dim.size()));
    if (!known) dim.push_back(result.is_pose(v) ? d + 1 : 1);
  }
  result.system = make_least_squares(std::move(dim), d);
  for (const MotionEdge& edge : result.edges) add_edge(result, edge);
  return result;
}

template <int d>
Eigen::Matrix<double, d, d> nearest_rotation(const Eigen::Matrix<double, d, d>& M) {
  if constexpr (d == 2) {
    const double c = M(0, 0) + M(1, 1), s = M(1, 0) - M(0, 1);
    return geometry::rotation(std::atan2(s, c));
  } else {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d U = svd.matrixU();
    if (U.determinant() * svd.matrixV().determinant() < 0) U.col(2) *= -1;
    return U * svd.matrixV().transpose();
  }
}

// Turns the poses to their rows of x. How far, squared, on average.
template <int d>
double project(Relaxation<d>& relaxation, const Triangle& factor, const Rows& x) {
  double sum = 0, count = 0;
  for (std::size_t v = 0; v < relaxation.unknown.size(); ++v) {
    const auto vertex = static_cast<Index>(v);
    if (relaxation.stays(vertex) || !relaxation.is_pose(vertex)) continue;
    const Index first = factor.row(relaxation.unknown[v]);
    const Eigen::Matrix<double, d, d> M = x.block<d, d>(first, 0).transpose();
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    R.topLeftCorner<d, d>() = nearest_rotation<d>(M);
    sum += (R - factor::rotation(relaxation.problem, relaxation.values, vertex)).squaredNorm();
    ++count;
    factor::set_rotation(relaxation.problem, vertex, R, relaxation.values);
  }
  return count > 0 ? sum / count : 0;
}

// u, by vertex.
template <int d>
std::vector<double> pulls(const Relaxation<d>& relaxation) {
  std::vector<double> sum(relaxation.unknown.size(), 0), count(relaxation.unknown.size(), 0);
  for (const auto& [i, j, motion] : relaxation.edges) {
    for (Index v : {i, j}) {
      if (v == world || !(motion.turn_information > 0)) continue;
      sum[v] += motion.turn_information;
      ++count[v];
    }
  }
  for (std::size_t v = 0; v < sum.size(); ++v) sum[v] *= count[v] > 0 ? pull / count[v] : 0;
  return sum;
}

template <int d>
void relax(const factor::Problem& problem, factor::Values& values) {
  Relaxation<d> relaxation = make_relaxation<d>(problem, values);
  LeastSquares& system = relaxation.system;
  if (system.right.size() == 0) return;
  Elimination elimination = plan_elimination(system);
  const Triangle factor = triangle(elimination);
  eliminate(system, {}, elimination);
  const Rows right = right_side(system, factor);
  Rows x = right;
  solve(factor, d, x);
  project(relaxation, factor, x);

  const std::vector<double> u = pulls(relaxation);
  const auto for_pulled = [&](auto&& work) {  // of what has an unknown R
    for (std::size_t v = 0; v < u.size(); ++v) {
      const auto vertex = static_cast<Index>(v);
      if (!relaxation.stays(vertex) && u[v] > 0) work(vertex, relaxation.unknown[v]);
    }
  };
  std::vector<double> damping(static_cast<std::size_t>(system.right.rows()), 0);
  for_pulled([&](Index v, Index j) { std::fill_n(damping.begin() + system.at[j], d, u[v]); });
  eliminate(system, damping, elimination);
  for (int round = 0; round < most_rounds; ++round) {
    x = right;
    for_pulled([&](Index v, Index j) {
      x.block<d, d>(factor.row(j), 0) += u[v] * relaxation.rotation(v).transpose();
    });
    solve(factor, d, x);
    if (project(relaxation, factor, x) < settled * settled) break;
  }
}

}  // namespace

void relax_rotations(const factor::Problem& problem, factor::Values& values) {
  relax<2>(problem, values);
  relax<3>(problem, values);
}

}  // namespace sg::solve
