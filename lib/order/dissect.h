// Nested dissection for graphs that are wide in all directions (George 1973; Lipton, Rose, Tarjan 1979), down to pieces
// that weighted minimum fill orders.
//
// Separators (separator.h) part the graph again and again. Small pieces are ordered by a greedy pass that knows what is
// around them (fill_graph.h): what a piece costs depends on no other, so that the elimination complexity of all is the sum of
// what the pieces say. Larger ones are ordered so, too, as long as that comes near in one of their parts, and the cheaper
// order stays; but not a whole graph, whose minimum fill is for the caller to try.
//
// Time: every level of pieces looks at every edge a few dozen times, and there are about log2(n / 300) levels. Memory
// O(n + m). One thread; the same order on any machine with the same METIS.
#pragma once

#include <cstdint>

#include "lib/elim/score.h"
#include "lib/graph/pattern.h"

namespace sg::order {

// Of the first `inner` variables. The others are around them and eliminated later; how they are joined does not matter.
struct Dissected {
  graph::Order order;
  elim::Wide ec;  // of it, exactly, as the pieces say
};
Dissected nested_dissection(const graph::Adjacency& graph, const std::vector<int>& dim, Index inner,
                            std::uint64_t seed);

// The same of all that is left of a graph once all has gone that any good order may begin with: what is simplicial or has at
// most three neighbours. Indistinguishable variables go together.
graph::Order dissect(const graph::Adjacency& graph, const std::vector<int>& dim,
                     std::uint64_t seed);

}  // namespace sg::order
