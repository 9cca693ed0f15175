// Breadth-first search.
#pragma once

#include <vector>

#include "lib/graph/lists.h"

namespace sg::order {

constexpr Index not_met = -1;

// Appends what can be met from `root`, level by level. distance: not_met of whatever may be; of what has been, that of the
// root, which is `from`, and the edges from there.
inline void breadth_first(const graph::Lists<>& graph, Index root, Index from,
                          std::vector<Index>& distance, std::vector<Index>& sequence) {
  std::size_t at = sequence.size();
  distance[root] = from;
  sequence.push_back(root);
  for (; at < sequence.size(); ++at) {
    const Index v = sequence[at];
    for (const Index u : graph[v]) {
      if (distance[u] != not_met) continue;
      distance[u] = distance[v] + 1;
      sequence.push_back(u);
    }
  }
}

}  // namespace sg::order
