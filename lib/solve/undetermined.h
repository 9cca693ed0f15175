// Which variables a singular system leaves undetermined: those that move in its null space.
#pragma once

#include <string>
#include <vector>

#include "lib/factor/linearize.h"

namespace sg {

// Ascending. H, scaled to a unit diagonal, is factorized L D L' with vanished pivots held at a tiny value; solving for
// a random right-hand side then gives, but for a negligible part, a random vector of the null space (inverse iteration
// with a perfect shift; Golub, Van Loan, section 8.2.2).
std::vector<Index> undetermined_variables(const LinearSystem& system, const Order& order);

// "vertex 5" or "vertices 3, 7-12 and 15", from ascending ids; at most 20 ranges, then "and 7 more".
std::string id_ranges(const std::vector<Id>& ids);

}  // namespace sg
