#include "lib/solve/least_squares.h"

#include <oneapi/tbb/global_control.h>

#include "lib/factor/problem.h"
#include "lib/order/order.h"
#include "lib/solve/normal_equations.h"
#include "lib/text/error.h"

namespace sg::solve {
namespace {

constexpr double share = 1e-9;

// With more on the diagonal for what is left undetermined.
std::vector<double> more_damping(const LeastSquares& problem, std::vector<double> damping) {
  std::vector<double> diagonal, unused;
  diagonal_and_gradient(problem.system, diagonal, unused);
  damping.resize(diagonal.size(), 0);
  for (std::size_t k = 0; k < diagonal.size(); ++k)
    damping[k] += diagonal[k] > 0 ? share * diagonal[k] : 1;
  return damping;
}

}  // namespace

LeastSquares make_least_squares(std::vector<int> dim, int sides) {
  LeastSquares result;
  result.at = factor::starts(dim);
  result.pattern.dim = std::move(dim);
  result.system.begin.push_back(0);
  result.right = Eigen::MatrixXd::Zero(result.at.back(), sides);
  return result;
}

void add_row(LeastSquares& problem, std::span<const Index> variables,
             const Eigen::Ref<const Eigen::MatrixXd>& A,
             const Eigen::Ref<const Eigen::MatrixXd>& B) {
  problem.pattern.rows.add(variables);
  factor::LinearSystem& system = problem.system;
  system.height.push_back(static_cast<int>(A.rows()));
  system.numbers.insert(system.numbers.end(), A.reshaped().begin(), A.reshaped().end());
  system.numbers.resize(system.numbers.size() + static_cast<std::size_t>(A.rows()), 0);
  system.begin.push_back(static_cast<Offset>(system.numbers.size()));
  Eigen::Index column = 0;
  for (const Index j : variables) {
    const int dim = problem.pattern.dim[j];
    problem.right.middleRows(problem.at[j], dim) += A.middleCols(column, dim).transpose() * B;
    column += dim;
  }
}

Elimination plan_elimination(LeastSquares& problem) {
  problem.system.pattern = &problem.pattern;
  const std::size_t threads =
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return plan_elimination(problem.system, order::elimination_order("amd", problem.pattern),
                          static_cast<int>(threads));
}

void eliminate(LeastSquares& problem, const std::vector<double>& damping,
               Elimination& elimination) {
  problem.system.pattern = &problem.pattern;
  if (eliminate(elimination, problem.system, damping).empty()) return;
  if (!eliminate(elimination, problem.system, more_damping(problem, damping)).empty())
    throw text::computation_error("a linear system is too badly scaled to be solved");
}

Rows right_side(const LeastSquares& problem, const Triangle& triangle) {
  const Eigen::Index sides = problem.right.cols();
  Rows result = Rows::Zero(problem.right.rows(), round_up(static_cast<int>(sides)));
  for (Index j = 0; j < problem.pattern.variables(); ++j) {
    const int dim = problem.pattern.dim[j];
    result.block(triangle.row(j), 0, dim, sides) = problem.right.middleRows(problem.at[j], dim);
  }
  return result;
}

void solve(const Triangle& triangle, Eigen::Index sides, Rows& x) {
  RowsRef columns = x.leftCols(sides);
  solve_lower(triangle, columns);
  solve_upper(triangle, columns);
}

}  // namespace sg::solve
