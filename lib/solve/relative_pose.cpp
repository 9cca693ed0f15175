#include "lib/solve/relative_pose.h"

#include <Eigen/Dense>
#include <array>
#include <limits>
#include <vector>

#include "lib/factor/space.h"
#include "lib/factor/whitening.h"
#include "lib/geometry/information.h"
#include "lib/geometry/numbers.h"
#include "lib/geometry/triangle.h"

namespace sg::solve {
namespace {

using geometry::UncertainSE2;
using geometry::UncertainSE3;

template <class Matrix>
Matrix information_of(const factor::Problem& problem, Index e) {
  const Eigen::Map<const Matrix> U(factor::whitening_of(problem, e).U);
  return U.transpose() * U;
}

template <class Matrix>
double position_variance(const Matrix& information, int first, int size) {
  const Eigen::LDLT<Matrix> ldlt(information);
  const auto D = ldlt.vectorD();
  if (!(D.minCoeff() > 1e-12 * D.maxCoeff())) return std::numeric_limits<double>::infinity();
  const Matrix covariance = ldlt.solve(Matrix::Identity());
  return covariance.diagonal().segment(first, size).sum();
}

}  // namespace

bool is_relative_pose(const Graph& graph, Index e) {
  return graph.edge_tag(e) == graph::EdgeTag::se2 || graph.edge_tag(e) == graph::EdgeTag::se3 ||
         graph.edge_tag(e) == graph::EdgeTag::expmap;
}

RelativePose relative_pose(const factor::Problem& problem, Index e) {
  const double* const z = factor::constants_of(problem, e);
  if (problem.graph->edge_tag(e) == graph::EdgeTag::se2)
    return UncertainSE2{geometry::se2(z), information_of<Eigen::Matrix3d>(problem, e)};
  if (problem.graph->edge_tag(e) == graph::EdgeTag::se3)
    return UncertainSE3{geometry::se3(z), information_of<Matrix6d>(problem, e)};
  return UncertainExpmap{geometry::inverse(geometry::se3(z)), information_of<Matrix6d>(problem, e)};
}

RelativePose compose(const RelativePose& first, const RelativePose& second) {
  if (const auto* a = std::get_if<UncertainSE2>(&first))
    return geometry::compose(*a, std::get<UncertainSE2>(second));
  if (const auto* a = std::get_if<UncertainSE3>(&first))
    return geometry::compose(*a, std::get<UncertainSE3>(second));
  const auto& a = std::get<UncertainExpmap>(first);
  const auto& b = std::get<UncertainExpmap>(second);
  return UncertainExpmap{geometry::compose(a.mean, b.mean),
                         geometry::parallel_sum(a.information, b.information)};
}

RelativePose inverse(const RelativePose& pose) {
  if (const auto* a = std::get_if<UncertainSE2>(&pose)) return geometry::inverse(*a);
  if (const auto* a = std::get_if<UncertainSE3>(&pose)) return geometry::inverse(*a);
  const auto& a = std::get<UncertainExpmap>(pose);
  return UncertainExpmap{geometry::inverse(a.mean), a.information};
}

double variance(const RelativePose& pose) {
  if (const auto* a = std::get_if<UncertainSE2>(&pose))
    return position_variance(a->information, 0, 2);
  if (const auto* a = std::get_if<UncertainSE3>(&pose))
    return position_variance(a->information, 0, 3);
  return position_variance(std::get<UncertainExpmap>(pose).information, 3, 3);
}

void place(const RelativePose& pose, const double* first, double* second) {
  if (const auto* a = std::get_if<UncertainSE2>(&pose)) {
    geometry::set_se2(geometry::compose(geometry::se2(first), a->mean), second);
  } else if (const auto* b = std::get_if<UncertainSE3>(&pose)) {
    geometry::set_se3(geometry::compose(geometry::se3(first), b->mean), second);
  } else {  // estimates map world to camera
    const SE3 back = geometry::inverse(std::get<UncertainExpmap>(pose).mean);
    geometry::set_se3(geometry::compose(back, geometry::se3(first)), second);
  }
}

void blend(graph::Space space, const double* other, double share, double* x) {
  if (space == graph::Space::se2) {
    for (int k = 0; k < 2; ++k) x[k] += share * (other[k] - x[k]);
    x[2] = geometry::wrap(x[2] + share * geometry::wrap(other[2] - x[2]));
    return;
  }
  std::array<double, 7> a, b;  // as files have them: where the pose is
  factor::to_file(space, x, a.data());
  factor::to_file(space, other, b.data());
  SE3 pose = geometry::se3(a.data());
  const SE3 to = geometry::se3(b.data());
  pose.t += share * (to.t - pose.t);
  pose.q = pose.q.slerp(share, to.q);
  geometry::set_se3(pose, a.data());
  factor::from_file(space, a.data(), x);
}

void rewrite(Rewritable& own, Index e, Index first, Index second, const RelativePose& pose) {
  factor::Problem& problem = own.problem;
  const auto put = [e](graph::Lists<>& lists, Index a, Index b) {
    const Index at = lists.begin[e];
    lists.items[at] = a;
    lists.items[at + 1] = b;
  };
  put(own.graph.edge_vertices, first, second);
  put(problem.variables.pattern.rows, problem.variables.vertex_variable[first],
      problem.variables.vertex_variable[second]);
  std::vector<double> numbers, triangle;
  const auto take = [&](const auto& p) {
    const auto mean = geometry::numbers_of(p.mean);
    const auto upper = geometry::upper_triangle(p.information);
    numbers.assign(mean.begin(), mean.end());
    triangle.assign(upper.begin(), upper.end());
  };
  std::visit(take, pose);
  const int dim = factor::dim_of(problem, e);
  problem.model[e]->prepare(numbers.data(), nullptr,
                            problem.constants.data() + problem.constants_at[e]);
  problem.diagonal[e] = geometry::is_diagonal(triangle, dim);
  factor::whitening(triangle, dim, problem.whitening.data() + problem.whitening_at[e]);
}

std::unique_ptr<Rewritable> rewritable(const factor::Problem& problem) {
  auto result = std::make_unique<Rewritable>(Rewritable{*problem.graph, problem});
  result->problem.graph = &result->graph;
  std::vector<double> whitening;  // every edge's its own
  for (Index e = 0; e < result->graph.edges(); ++e) {
    const double* const U = factor::whitening_of(problem, e).U;
    const int dim = factor::dim_of(problem, e);
    result->problem.whitening_at[e] = static_cast<Index>(whitening.size());
    whitening.insert(whitening.end(), U, U + static_cast<std::ptrdiff_t>(dim) * dim);
  }
  result->problem.whitening = std::move(whitening);
  return result;
}

}  // namespace sg::solve
