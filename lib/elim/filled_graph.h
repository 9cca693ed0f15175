// The filled graph of an elimination in a fixed order, and how EC grows as factors are added to it.
//
// A factor joins its variables in one clique. Its first variable, k, gets the others into its
// separator; what is new there goes on to the parent of k, the first of the separator, and so up the
// elimination tree until nothing is new. A new parent takes over all of the separator. A factor whose
// variables stand together in a clique of the Bayes tree changes nothing: it is free. Variables are
// called by their position in the order.
#pragma once

#include <span>
#include <vector>

#include "lib/elim/score.h"

namespace sg::elim {

struct FilledGraph {
  std::vector<int> dim;                       // d_f
  std::vector<std::vector<Index>> separator;  // ascending
  std::vector<std::int64_t> count;            // d_f + d_s; 0 of a variable that has no factor yet
  Wide ec = 0;                                // of the variables that have one
  std::vector<Index> wanted, added, merged;   // of a walk
};

// absent: how many variables, the first in the order, have no factor and no part in EC before they
// get one.
FilledGraph filled_graph(const OrderedPattern& pattern, Index absent = 0);

// By how much EC grows with a factor of these variables, ascending. O(path in the tree) set
// operations. Nothing changes but the walk's own lists.
Wide increase(FilledGraph& filled, std::span<const Index> factor);
// Adds it; returns the increase.
Wide add_factor(FilledGraph& filled, std::span<const Index> factor);

}  // namespace sg::elim
