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

// Items 0 .. count - 1, each alone at first.
struct DisjointSets {
  explicit DisjointSets(Index count);
  std::vector<Index> rank, parent;
};
// One item that stands for all of k's set.
Index find(DisjointSets& sets, Index k);
// Makes one set of two. Whether they were two.
bool join(DisjointSets& sets, Index a, Index b);

// Number of vertices of every component.
std::vector<Index> sizes(const Components& components);

}  // namespace sg::graph
