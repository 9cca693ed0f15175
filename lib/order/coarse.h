// Dissection of a graph that is too large for its budget.
//
// Two breadth-first searches find levels from a far end (levels.h). The smallest level in the middle half is the separator,
// and what comes before and after it is parted again, down to an eighth of the graph, which amd orders with what is around it
// in mind. Parts are ordered by several threads, and amd is quicker on a part that fits into the caches than on the whole:
// half of its time on one thread for a city of a million poses, at four times its elimination complexity.
//
// The same order on any number of threads. Time O(m) beside amd's, memory O(n + m).
#pragma once

#include "lib/graph/pattern.h"

namespace sg::order {

// leaf: of so many vertices a part is not parted any more.
graph::Order coarse_dissection(const graph::Adjacency& graph, Index leaf);

}  // namespace sg::order
