#include "lib/graph/components.h"

#include <boost/pending/disjoint_sets.hpp>
#include <cassert>

namespace sg::graph {

Components components(const Graph& graph, const std::vector<bool>& edge_removed) {
  return components(graph.edge_vertices, graph.vertices(), edge_removed);
}

Components components(const Lists<>& lists, Index count, const std::vector<bool>& list_removed) {
  assert(list_removed.empty() || std::ssize(list_removed) == lists.size());
  std::vector<Index> rank(count);
  std::vector<Index> parent(count);
  boost::disjoint_sets<Index*, Index*> sets(rank.data(), parent.data());
  for (Index v = 0; v < count; ++v) sets.make_set(v);
  for (Index k = 0; k < lists.size(); ++k) {
    if (!list_removed.empty() && list_removed[k]) continue;
    for (Index v : lists[k]) sets.union_set(lists[k].front(), v);
  }
  Components result;
  std::vector<Index> number(count, -1);
  for (Index v = 0; v < count; ++v) {
    Index& component = number[sets.find_set(v)];
    if (component < 0) component = result.count++;
    result.of.push_back(component);
  }
  return result;
}

std::vector<Index> sizes(const Components& components) {
  std::vector<Index> size(components.count, 0);
  for (Index component : components.of) ++size[component];
  return size;
}

}  // namespace sg::graph
