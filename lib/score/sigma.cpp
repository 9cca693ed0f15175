#include "lib/score/sigma.h"

#include <cmath>

namespace sg::score {

std::vector<PoseSigma> pose_sigmas(const factor::Problem& problem, const factor::Values& values,
                                   solve::Elimination& elimination) {
  const std::vector<Eigen::MatrixXd> covariance = vertex_covariances(problem, elimination);
  std::vector<PoseSigma> result;
  for (Index v = 0; v < problem.graph->vertices(); ++v) {
    if (problem.graph->role(v) != graph::Role::pose) continue;
    const double* const x = values.data() + problem.value_at[v];
    result.push_back(
        {v, std::sqrt(position_covariance(problem.space[v], x, covariance[v]).trace())});
  }
  return result;
}

}  // namespace sg::score
