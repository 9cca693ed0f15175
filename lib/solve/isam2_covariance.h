// Covariances out of a smoother's Bayes tree.
//
// Of the whole system R'R = A'A the tree is R, by cliques. With a measurement's Jacobian J, U = R^-T J' has rows in none
// but the cliques from J's variables to the root, and J (A'A)^-1 J' = U'U: one forward substitution along that path.
#pragma once

#include <Eigen/Core>

#include "lib/solve/isam2.h"

namespace sg::solve {

// J S J' for the covariance S of the estimate; jacobian: columns of the variables, which are there, one after the other.
// Takes the time of a pass over the cliques between them and the root.
Eigen::MatrixXd projected_covariance(Isam2& isam, std::span<const Index> variables,
                                     const Eigen::MatrixXd& jacobian);

// The covariance of variable j, which is there.
Eigen::MatrixXd covariance(Isam2& isam, Index j);

// Cliques from those of the variables to the root, children before parents. Overwrites `path`.
void path_to_root(const Isam2& isam, std::span<const Index> variables, std::vector<Index>& path);

}  // namespace sg::solve
