// What an admission of measurements asks of the Bayes tree: what a measurement would add to what is known, and what it
// would cost, before anything is eliminated.
//
// Price. A row over variables that no clique holds together has to bring them together: put variable v into the cliques
// between the one where it is frontal and the nearest that holds u, and EC_BT rises by f ((n + d_v)^2 - n^2) for each of
// these, with n = f + s. Of u's way to v and v's way to u the cheaper is taken. A row whose variables stand in one clique
// is free. The update will order the way anew, mostly for less.
//
// Gain. With the covariance S, a measurement of whitened Jacobian J makes the variance of a pose's position fall by the
// trace of  S_p J' (I + C)^-1 J S_p',  C = J S J'. Of the variables that J has it is exact; along the path between two of
// them it is taken to change linearly, which is what closing a loop of equal links does. The sum over all poses between
// is the gain: by how much the sum of position variances falls (the trace, not the determinant: lib/prune/information_gain.h
// says why). What giving a row back would lose is the same with (I - C)^-1.
#pragma once

#include <Eigen/Core>

#include "lib/solve/isam2.h"

namespace sg::solve {

// Some rows as one measurement of variables that are there.
struct Measurement {
  std::vector<Index> variables;
  Eigen::MatrixXd
      jacobian;  // whitened, at the linearization points; columns of the variables one after the other
};

// Rows whose variables are there but for one at most, which is eliminated from them: what they say of the others. Nothing
// (no variables) where they do not determine it. -1: all are there.
Measurement measurement(const Isam2& isam, std::span<const Index> rows, Index variable = -1);

// place: by variable, its pose's index; of a landmark, that of the pose that saw it first. Those between two places are
// so many poses. given_back: what taking it away would lose.
double gain(Isam2& isam, const Measurement& measurement, std::span<const Index> place,
            bool given_back = false);

// By how much EC_BT rises at most, by the tree as it is. `extra`: scalars of a variable that is eliminated on top of them,
// 0 for none.
double price(const Isam2& isam, std::span<const Index> variables, int extra = 0);

}  // namespace sg::solve
