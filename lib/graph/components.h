// Connected components: vertices that edges join, whatever their roles.
#pragma once

#include <vector>

#include "lib/graph/graph.h"

namespace sg::graph {

struct Components {
  Index count = 0;
  std::vector<Index> of;  // n: the component of every vertex; numbered by their first vertex
};
// Without the edges that are marked, if any are.
Components components(const Graph& graph, const std::vector<bool>& edge_removed = {});
// The same of items 0 .. count - 1 that every list joins.
Components components(const Lists<>& lists, Index count,
                      const std::vector<bool>& list_removed = {});

// Number of vertices of every component.
std::vector<Index> sizes(const Components& components);

}  // namespace sg::graph
