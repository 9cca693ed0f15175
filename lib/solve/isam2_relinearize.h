// Fluid relinearization (isam2.h, step 2): algorithm 5 of the paper, and the factors' numbers.
#pragma once

#include "lib/solve/isam2.h"

namespace sg::solve {

// Linearizes row r at the linearization points of its variables: its Gram matrix, and the least
// pivots that it calls for. A landmark seen along a ray is damped, and where it cannot be seen the
// row says nothing of it (landmark_point.h). Throws check_row's Error.
void linearize_factor(Isam2& isam, Index r);

// Moves the linearization points of the variables that have gone too far, linearizes their rows
// again, and marks the cliques in which these stand. Returns how many variables moved.
Index relinearize(Isam2& isam);

// Marks clique c (none for -1) and its ancestors, to be taken out.
void mark_to_root(Isam2& isam, Index c);

}  // namespace sg::solve
