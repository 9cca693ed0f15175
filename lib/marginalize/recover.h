// Nonlinear factor recovery: of measurements with slopes J_k the informations W_k whose sum is nearest to a Gaussian
// of covariance S. What is minimized is twice the Kullback-Leibler divergence from it,
//     sum_k tr(W_k A_k) - log det(Q S) - m,      A_k = J_k S J_k',   Q = sum_k J_k' W_k J_k,   W_k >= 0,
// convex in the W_k (a determinant maximization problem).
//
// Where the stacked J is square, as of a spanning tree, W_k = A_k^-1 is the minimum. Of many pairs each W_k in turn is set
// to its best beside the others: with C = (J_k Q^-1 J_k')^-1 - W_k, what they know of the measurement, that is A_k^-1 - C
// without its negative part, in coordinates in which A_k = I (iterative proportional fitting, where C is no more than
// A_k^-1). Of few, and where more is asked, Newton's method follows
// the central path of the barrier  -r sum_k log det W_k  down to r = 0; where the result must not know more than there
// was, Q <= S^-1, with the barrier  -r log det(S^-1 - Q)  as well. The first step for a smaller r has the curvature of
// the barrier before: it is a step along the path's tangent, and goes all the way where a W_k vanishes in proportion to r.
//
// How far a minimum may be: for any W', log det Q' <= log det Q + tr(Q^-1 Q') - m, so that with J_k Q^-1 J_k' <= (1 + e) A_k
// the objective is at most  sum_k tr(W_k A_k) - m + e m  above its least.
//
// Sources: Mazuran, Burgard, Tipaldi, Nonlinear factor recovery for long-term SLAM (2016); Vandenberghe, Boyd, Wu,
// Determinant maximization with linear matrix inequality constraints (1998).
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace sg::marginalize {

// Minus infinity where it is not positive definite.
double log_det(const Eigen::MatrixXd& matrix);

struct Recovery {
  std::vector<Eigen::MatrixXd> information;  // W_k, positive definite
  double divergence;                         // of Kullback and Leibler
};

struct RecoveryOptions {
  bool conservative = false;  // Q <= S^-1
  double penalty = 0;         // times sum_k tr(W_k A_k) is minimized, too: how dear pairs are
  bool multiples = false;     // W_k = w_k A_k^-1, one unknown a pair
  double gap = 1e-4;          // that each W_k in turn may leave of twice the divergence
  int sweeps = 1000;          // of each in turn, at most
  double barrier = 5e-12;     // r at last: what Newton's method may leave for every row of all J_k
};

constexpr std::size_t most_unknowns =
    130;  // that Newton's method is taken for where it need not be

// slopes: J_k (d_k x m), of which each has full rank, as all of them together. covariance: S (m x m), regular.
Recovery recover(std::span<const Eigen::MatrixXd> slopes, const Eigen::MatrixXd& covariance,
                 const RecoveryOptions& options = {});

}  // namespace sg::marginalize
