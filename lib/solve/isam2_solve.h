// Partial state update (isam2.h, step 4): algorithm 7 of the paper.
#pragma once

#include "lib/solve/isam2.h"

namespace sg::solve {

// Solves from the new roots down to where steps change by less than the wildfire threshold, and
// brings the estimates up to date. False if one is not finite.
bool solve_down(Isam2& isam);

}  // namespace sg::solve
