#include "lib/factor/residuals.h"

#include <Eigen/Core>
#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <tuple>

namespace sg::factor {
namespace {

constexpr double rounding = 1e-7;  // of a root of an eigenvalue, beside the largest

}  // namespace

int degrees_of_freedom(const Problem& problem, Index e) {
  const int dim = problem.model[e]->dim;
  const Whitening whitening = whitening_of(problem, e);
  // A singular information's rows of U are its eigenvectors, as long as the roots of the eigenvalues.
  const Eigen::VectorXd length =
      Eigen::Map<const Eigen::MatrixXd>(whitening.U, dim, dim).rowwise().norm();
  return static_cast<int>((length.array() > rounding * length.maxCoeff()).count());
}

double chi2_quantile(double chi2, int degrees) {
  return degrees == 0 ? (chi2 > 0 ? 1 : 0) : boost::math::gamma_p(degrees / 2.0, chi2 / 2);
}

double chi2_of_quantile(double quantile, int degrees) {
  return degrees == 0 ? 0 : 2 * boost::math::gamma_p_inv(degrees / 2.0, quantile);
}

std::vector<Residual> residuals(const Problem& problem, const Values& values) {
  std::vector<Residual> result;
  result.reserve(problem.graph->edges());
  for (Index e = 0; e < problem.graph->edges(); ++e) {
    const double chi2 = finite_edge_chi2(problem, values, e);
    const int degrees = degrees_of_freedom(problem, e);
    result.push_back({e, chi2, degrees, chi2_quantile(chi2, degrees)});
  }
  return result;
}

void worst_first(std::vector<Residual>& residuals) {
  std::ranges::stable_sort(residuals, [](const Residual& a, const Residual& b) {
    return std::tie(a.quantile, a.chi2) > std::tie(b.quantile, b.chi2);
  });
}

}  // namespace sg::factor
