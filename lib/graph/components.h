// Connected components: vertices that edges join, whatever their roles.
#pragma once

#include <vector>

#include "lib/graph/graph.h"

namespace sg::graph {

struct Components {
  Index count = 0;
  std::vector<Index> of;  // n: the component of every vertex; numbered by their first vertex
};
Components components(const Graph& graph);
// The same without the edges that are marked.
Components components(const Graph& graph, const std::vector<bool>& edge_removed);

// Number of vertices of every component.
std::vector<Index> sizes(const Components& components);

}  // namespace sg::graph
