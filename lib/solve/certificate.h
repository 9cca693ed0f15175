// Whether an optimum is the global one: a lower bound on the chi-square of every estimate (Carlone, Rosen, Calafiore, Leonard,
// Dellaert, Lagrangian Duality in 3D SLAM: Verification Techniques and Optimal Solutions, 2015; Rosen, Carlone, Bandeira,
// Leonard, SE-Sync: A Certifiably Correct Algorithm for Synchronization over the Special Euclidean Group, 2019).
//
// Over rotations R_i and positions t_i, SE-Sync minimizes
//     f = sum over edges of  kappa |R_j - R_i R_ij|^2 + tau |t_j - t_i - R_i t_ij|^2  =  tr(X M X'),   X = [R | t],
// Frobenius norms, M sparse and positive semidefinite. With Q the Schur complement of M's positions and L block diagonal of
// symmetric blocks, tr(L R'R) = tr(L) since R_i' R_i = I, hence everywhere
//     f >= tr(Q R'R) = tr(L) + tr((Q - L) R'R) >= tr(L) + min(lambda, 0) d n,     lambda the least eigenvalue of Q - L,
// d the dimension and n the number of poses. The blocks L_i = sym(R_i' (X M)_i) of an optimum make tr(L) = f, and lambda = 0
// certifies it (SE-Sync, theorem 7); of any other estimate they make a bound that holds, and is worth little.
//
// An edge's e' W e is at least tau |e_t|^2 + w |e_r|^2 for an isotropic part of W: W - diag(tau I, w I) >= 0. The
// translation's term is f's. For the rotation's, by an angle theta,
//     EDGE_SE3:QUAT   |e_r|^2 = sin^2(theta / 2)            = 1/8 |R_j - R_i R_ij|^2     kappa = w / 8
//     EDGE_SE2        |e_r|^2 = theta^2 >= 2 - 2 cos(theta) = 1/2 |R_j - R_i R_ij|^2     kappa = w / 2
// So f is a bound of the file's own chi-square: in space the same where information is isotropic, in the plane by a share of
// theta^2 / 12 less, and less by what is not isotropic. EDGE_SE2_XY has a tau alone. Other edges count for 0.
#pragma once

#include "lib/factor/problem.h"

namespace sg::solve {

struct Certificate {
  double chi2;        // of the estimate
  double bound;       // no estimate has less
  double eigenvalue;  // lambda
  Index isotropic;    // edges that count in full
  Index in_part;      // edges whose information is not isotropic
  Index left_out;     // edges of other types
};

// No estimate's chi-square is lower by more than this share of it (or, where there is nearly none, by this much).
constexpr double certified_gap = 1e-3;
bool is_certified(const Certificate& certificate);

// Throws an input Error where no edge counts, a computation Error where an edge has no finite error or the iteration for the
// eigenvalue does not converge.
Certificate certify(const factor::Problem& problem, const factor::Values& values);

}  // namespace sg::solve
