// The inverse of A' A where it is wanted: marginal covariances of the linearized system, from the factor on its Bayes
// tree.
//
// With K = L21 L11^-1, a clique's frontal variables are x_f = -K' x_s + L11^-T w given its separator, w white, so that
//     S_sf = -S_ss K,     S_ff = L11^-T L11^-1 - K' S_sf.
// S_ss stands in its parent, since the separator does: from the roots down, all blocks of the inverse within a clique
// cost no more than a few factorizations, and nothing outside is formed. A block outside, of variables that no clique
// holds together, is X' X with L X the identity's columns of these variables: X is zero off their paths to the root.
// Source: Takahashi, Fagan, Chen, Formation of a sparse bus impedance matrix (1973); Kaess and Dellaert, Covariance
// recovery from a square root information matrix for data association (2009).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "lib/solve/eliminate.h"

namespace sg::solve {

// After eliminate, of a regular system: the covariance of every variable, dim x dim.
std::vector<Eigen::MatrixXd> marginal_covariances(Elimination& elimination);

// Of the system's rows, which are of the same structure as those that were eliminated and may be of other numbers: of
// every row A_r the trace of A_r S A_r', S the covariance of all variables.
std::vector<double> row_variances(Elimination& elimination, const factor::LinearSystem& system);
// The same whole, A_r S A_r'; empty of a row of zeros.
std::vector<Eigen::MatrixXd> row_covariances(Elimination& elimination,
                                             const factor::LinearSystem& system);

// log det of the information that some variables of a system have where the others are known: of W_RR. The marginal of the
// others has log det W less by that. Nothing where it is singular.
std::optional<double> log_determinant_given_others(const factor::LinearSystem& system,
                                                   const std::vector<bool>& some);

// x := S x, by scalar of a step.
void solve_normal_equations(Elimination& elimination, Eigen::VectorXd& x);

// The same of a few variables together, one's scalars after the other's.
Eigen::MatrixXd joint_covariance(Elimination& elimination, std::span<const Index> variables);

}  // namespace sg::solve
