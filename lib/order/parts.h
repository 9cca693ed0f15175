// Orderings of a block graph that is in several parts. The libraries' own orderings of graphs trip
// over vertices without neighbours, or grow slow with many parts; here they meet one connected part
// of at least two variables at a time.
#pragma once

#include <functional>
#include <vector>

#include "lib/graph/pattern.h"

namespace sg::order {

// A connected part of the graph of A^T A, its variables renumbered 0..size-1 in their order.
struct ConnectedPart {
  graph::Adjacency adjacency;
  std::vector<int> dim;
};

// Orders every part by itself, one after the other in order of their first variables. An ordering
// costs what its parts cost together, so nothing is lost.
graph::Order order_by_parts(const graph::Pattern& pattern,
                            const std::function<graph::Order(ConnectedPart&)>& order_part);

}  // namespace sg::order
