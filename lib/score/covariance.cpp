#include "lib/score/covariance.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "lib/factor/linearize.h"
#include "lib/factor/space.h"
#include "lib/solve/batch.h"
#include "lib/solve/marginals.h"

namespace sg::score {
namespace {

using Eigen::MatrixXd;

// From the frame that a step moves in to the world's. Estimates of expmap and of bal_camera map the world to it: with
// the step (w, v) on the left, a camera's centre -R' t moves by -R' v.
Eigen::Matrix3d axes(graph::Space space, const double* values) {
  if (!graph::has_quaternion(space)) return Eigen::Matrix3d::Identity();
  const Eigen::Quaterniond turn(values[6], values[3], values[4], values[5]);
  return space == graph::Space::se3 ? turn.toRotationMatrix() : turn.conjugate().toRotationMatrix();
}

// How many of the first scalars of a vertex's step are held still.
int standing(const factor::Problem& problem, Index v) {
  const Index j = problem.variables.vertex_variable[v];
  if (j < 0) return problem.graph->dim(v);
  return j == problem.held ? factor::held_dim(problem) : 0;
}

}  // namespace

std::optional<solve::Elimination> eliminated(const factor::Problem& problem,
                                             const factor::Values& values,
                                             const graph::Order& order) {
  return solve::eliminated(factor::linearized(problem, values), order);
}

text::Error singular_error(const factor::Problem& problem, const factor::Values& values) {
  return solve::singular_error(problem, values, factor::linearized(problem, values));
}

std::vector<MatrixXd> vertex_covariances(const factor::Problem& problem,
                                         solve::Elimination& elimination) {
  std::vector<MatrixXd> of_variable = solve::marginal_covariances(elimination);
  std::vector<MatrixXd> result(problem.graph->vertices());
  for (Index v = 0; v < problem.graph->vertices(); ++v) {
    const int dim = problem.graph->dim(v), still = standing(problem, v);
    result[v] = MatrixXd::Zero(dim, dim);
    if (still == dim) continue;
    result[v] = std::move(of_variable[problem.variables.vertex_variable[v]]);
    result[v].topRows(still).setZero();
    result[v].leftCols(still).setZero();
  }
  return result;
}

MatrixXd joint_covariance(const factor::Problem& problem, solve::Elimination& elimination, Index a,
                          Index b) {
  std::vector<Index> variables;
  std::vector<int> from,
      to;  // rows of what moves: of the variables' covariance, and of both vertices'
  int width = 0, row = 0;
  for (const Index v : {a, b}) {
    const int dim = problem.graph->dim(v);
    const Index j = problem.variables.vertex_variable[v];
    for (int k = standing(problem, v); k < dim; ++k) {
      from.push_back(width + k);
      to.push_back(row + k);
    }
    row += dim;
    if (j < 0) continue;
    variables.push_back(j);
    width += dim;
  }
  MatrixXd result = MatrixXd::Zero(row, row);
  if (!to.empty()) result(to, to) = solve::joint_covariance(elimination, variables)(from, from);
  return result;
}

MatrixXd position_covariance(graph::Space space, const double* values, const MatrixXd& covariance) {
  const auto [first, d] = graph::facts(space).translation;
  const MatrixXd turn = axes(space, values).topLeftCorner(d, d);
  return turn * covariance.block(first, first, d, d) * turn.transpose();
}

Ellipse ellipse(const MatrixXd& position_covariance) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(position_covariance);
  const Eigen::Index last = position_covariance.rows() - 1;
  Ellipse result;
  for (Eigen::Index k = last; k >= 0; --k)
    result.axes.push_back(std::sqrt(std::max(0.0, solver.eigenvalues()[k])));
  const Eigen::VectorXd longest = solver.eigenvectors().col(last);
  const double sign = longest[0] < 0 || (longest[0] == 0 && longest[1] < 0) ? -1 : 1;
  result.angle = std::atan2(sign * longest[1], sign * longest[0]);
  return result;
}

}  // namespace sg::score
