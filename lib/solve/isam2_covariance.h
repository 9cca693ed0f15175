// Covariances out of a smoother's Bayes tree.
//
// Of the whole system R'R = A'A the tree is R, by cliques. With the columns E of the identity that are some variables',
// U = R^-T E has rows in none but the cliques from these variables to the root, and E'(A'A)^-1 E = U'U: one forward
// substitution along that path.
#pragma once

#include <Eigen/Core>

#include "lib/solve/isam2.h"

namespace sg::solve {

// The joint covariance of these variables, which are there, one after the other. Takes the time of a pass over the cliques
// between them and the root.
Eigen::MatrixXd covariance(Isam2& isam, std::span<const Index> variables);
// Of one.
Eigen::MatrixXd covariance(Isam2& isam, Index j);

// Cliques from those of the variables to the root, children before parents. Overwrites `path`.
void path_to_root(const Isam2& isam, std::span<const Index> variables, std::vector<Index>& path);

}  // namespace sg::solve
