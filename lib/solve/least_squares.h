// Linear least squares by blocks of unknowns: the X, n x k, that minimizes
//     sum over rows r of  |A_r X - B_r|^2,
// k problems with one matrix, which is eliminated on its Bayes tree (eliminate.h) by amd's order.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "lib/factor/linearize.h"
#include "lib/graph/pattern.h"
#include "lib/solve/eliminate.h"
#include "lib/solve/triangular.h"

namespace sg::solve {

struct LeastSquares {
  graph::Pattern pattern;       // unknowns: its variables
  std::vector<Index> at;        // where a variable's rows of X start; n is last
  factor::LinearSystem system;  // its blocks: [A_r 0]
  Eigen::MatrixXd right;        // A'B
};
LeastSquares make_least_squares(std::vector<int> dim, int sides);

// variables: distinct. A: one column for each of their scalars. B: k columns.
void add_row(LeastSquares& problem, std::span<const Index> variables,
             const Eigen::Ref<const Eigen::MatrixXd>& A,
             const Eigen::Ref<const Eigen::MatrixXd>& B);

// Once all rows are there.
Elimination plan_elimination(LeastSquares& problem);
// Of A'A + diag(damping). What nothing determines is damped by a share of 1e-9 of the diagonal (by 1 where that is 0), which
// keeps it near 0. Throws a computation Error where that does not help: of numbers that are too far apart.
void eliminate(LeastSquares& problem, const std::vector<double>& damping, Elimination& elimination);
// A'B in elimination order, as triangular.h has it: the rows of a variable start at triangle.row(variable).
Rows right_side(const LeastSquares& problem, const Triangle& triangle);
// X for such a right-hand side of so many columns, in place.
void solve(const Triangle& triangle, Eigen::Index sides, Rows& x);

}  // namespace sg::solve
