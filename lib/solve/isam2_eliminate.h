// Elimination of a clique of the incremental smoother (isam2.h, step 3c): algorithm 2 of the paper,
// for all frontal variables at once.
#pragma once

#include "lib/solve/isam2.h"

namespace sg::solve {

// Sums clique c's front up from its rows and its children's updates, and eliminates its frontal
// variables. Appends those of them with a pivot that vanished to `undetermined`.
void eliminate_clique(Isam2& isam, Index c, std::vector<Index>& undetermined);

}  // namespace sg::solve
