#include "lib/solve/chordal.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>

#include "lib/factor/gauge.h"
#include "lib/factor/motion.h"
#include "lib/geometry/se2.h"
#include "lib/sparse/least_squares.h"

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
  std::vector<Index> at;  // of every vertex: d numbers of R, of a pose, then one of t; -1: it stays
  sparse::LeastSquares system{0, d};

  bool is_pose(Index v) const { return v != world && problem.graph->role(v) == graph::Role::pose; }
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

// a' x = b, for each of the d rows x.
template <int d>
struct Equation {
  std::vector<sparse::Term> a;
  Eigen::Matrix<double, d, 1> b = Eigen::Matrix<double, d, 1>::Zero();
};

// Adds `factor` times column c of v's [R t].
template <int d>
void add_column(const Relaxation<d>& relaxation, Index v, int c, double factor,
                Equation<d>& equation) {
  const bool turns = relaxation.is_pose(v);
  if (v != world && relaxation.at[v] >= 0 && (turns || c == d)) {
    equation.a.push_back({relaxation.at[v] + (turns ? c : 0), factor});
  } else {
    equation.b -= factor * relaxation.known_column(v, c);
  }
}

template <int d>
void add_edge(Relaxation<d>& relaxation, const MotionEdge& edge) {
  const auto& [i, j, motion] = edge;
  for (int a = 0; a < d && motion.turn_information > 0; ++a) {
    Equation<d> turn;
    add_column(relaxation, j, a, 1, turn);
    for (int c = 0; c < d; ++c) add_column(relaxation, i, c, -motion.R(c, a), turn);
    add_square(relaxation.system, motion.turn_information / 2, turn.a, {turn.b.data(), d});
  }
  if (!(motion.place_information > 0)) return;
  Equation<d> place;
  add_column(relaxation, j, d, 1, place);
  add_column(relaxation, i, d, -1, place);
  for (int c = 0; c < d; ++c) add_column(relaxation, i, c, -motion.t[c], place);
  add_square(relaxation.system, motion.place_information, place.a, {place.b.data(), d});
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
  Relaxation<d> result{problem, values, motion_edges(problem, d, left_out), {}};
  const std::vector<bool> stays = factor::anchors(problem, left_out);
  Index unknowns = 0;
  for (Index v = 0; v < graph.vertices(); ++v) {
    const bool known = stays[v] || dimensions(problem.space[v]) != d;
    result.at.push_back(known ? -1 : unknowns);
    if (!known) unknowns += result.is_pose(v) ? d + 1 : 1;
  }
  result.system = sparse::LeastSquares(unknowns, d);
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
double project(Relaxation<d>& relaxation, const std::vector<double>& x) {
  double sum = 0, count = 0;
  for (std::size_t v = 0; v < relaxation.at.size(); ++v) {
    const auto vertex = static_cast<Index>(v);
    if (relaxation.at[v] < 0 || !relaxation.is_pose(vertex)) continue;
    Eigen::Matrix<double, d, d> M;
    for (int k = 0; k < d; ++k) {
      for (int c = 0; c < d; ++c)
        M(k, c) = x[k * relaxation.system.unknowns + relaxation.at[v] + c];
    }
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
  std::vector<double> sum(relaxation.at.size(), 0), count(relaxation.at.size(), 0);
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
  sparse::LeastSquares& system = relaxation.system;
  if (system.unknowns == 0) return;
  const std::vector<double> right = system.right;
  sparse::NormalFactor normal;
  factorize(system, normal);
  project(relaxation, sparse::solve(normal, system.right));

  const std::vector<double> u = pulls(relaxation);
  const auto for_numbers = [&](auto&& work) {  // of all unknown R
    for (std::size_t v = 0; v < u.size(); ++v) {
      if (relaxation.at[v] < 0 || !(u[v] > 0)) continue;
      for (int c = 0; c < d; ++c) work(static_cast<Index>(v), c, relaxation.at[v] + c);
    }
  };
  for_numbers([&](Index v, int, Index column) { system.lower.add(column, column, u[v]); });
  factorize(system, normal);
  for (int round = 0; round < most_rounds; ++round) {
    system.right = right;
    for_numbers([&](Index v, int c, Index column) {
      const auto R = relaxation.rotation(v);
      for (int k = 0; k < d; ++k) system.right[k * system.unknowns + column] += u[v] * R(k, c);
    });
    if (project(relaxation, sparse::solve(normal, system.right)) < settled * settled) break;
  }
}

}  // namespace

void relax_rotations(const factor::Problem& problem, factor::Values& values) {
  relax<2>(problem, values);
  relax<3>(problem, values);
}

}  // namespace sg::solve
