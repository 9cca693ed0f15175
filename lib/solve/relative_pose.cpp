#include "lib/solve/relative_pose.h"

#include <Eigen/Dense>
#include <limits>
#include <vector>

#include "lib/factor/whitening.h"
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
double position_variance(const Matrix& information, int size) {
  const Eigen::LDLT<Matrix> ldlt(information);
  const auto D = ldlt.vectorD();
  if (!(D.minCoeff() > 1e-12 * D.maxCoeff())) return std::numeric_limits<double>::infinity();
  const Matrix covariance = ldlt.solve(Matrix::Identity());
  return covariance.diagonal().head(size).sum();
}

}  // namespace

bool is_relative_pose(const Graph& graph, Index e) {
  return graph.edge_tag(e) == graph::EdgeTag::se2 || graph.edge_tag(e) == graph::EdgeTag::se3;
}

RelativePose relative_pose(const factor::Problem& problem, Index e) {
  const double* const z = factor::constants_of(problem, e);
  if (problem.graph->edge_tag(e) == graph::EdgeTag::se2)
    return UncertainSE2{geometry::se2(z), information_of<Eigen::Matrix3d>(problem, e)};
  return UncertainSE3{geometry::se3(z), information_of<Matrix6d>(problem, e)};
}

RelativePose compose(const RelativePose& first, const RelativePose& second) {
  if (const auto* a = std::get_if<UncertainSE2>(&first))
    return geometry::compose(*a, std::get<UncertainSE2>(second));
  return geometry::compose(std::get<UncertainSE3>(first), std::get<UncertainSE3>(second));
}

RelativePose inverse(const RelativePose& pose) {
  return std::visit([](const auto& p) -> RelativePose { return geometry::inverse(p); }, pose);
}

double variance(const RelativePose& pose) {
  if (const auto* a = std::get_if<UncertainSE2>(&pose)) return position_variance(a->information, 2);
  return position_variance(std::get<UncertainSE3>(pose).information, 3);
}

void place(const RelativePose& pose, const double* first, double* second) {
  if (const auto* a = std::get_if<UncertainSE2>(&pose)) {
    geometry::set_se2(geometry::compose(geometry::se2(first), a->mean), second);
  } else {
    geometry::set_se3(geometry::compose(geometry::se3(first), std::get<UncertainSE3>(pose).mean),
                      second);
  }
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
  auto result = std::make_unique<Rewritable>(*problem.graph, problem);
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
