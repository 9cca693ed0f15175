// How a replay through iSAM2 is held.
#pragma once

#include "lib/factor/problem.h"

namespace sg::isam2 {

// A replay needs its gauge from the first step on; what holds the whole graph may come later. Holds the first pose where
// nothing else does so in the first step; true where it had to.
bool hold_at_first(factor::Problem& problem);

}  // namespace sg::isam2
