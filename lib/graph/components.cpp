#include "lib/graph/components.h"

#include <boost/pending/disjoint_sets.hpp>
#include <cassert>

namespace sg::graph {

Components components(const Graph& graph) {
  return components(graph, std::vector<bool>(graph.edges(), false));
}

Components components(const Graph& graph, const std::vector<bool>& edge_removed) {
  assert(edge_removed.size() == graph.edge_type.size());
  const Index n = graph.vertices();
  std::vector<Index> rank(n);
  std::vector<Index> parent(n);
  boost::disjoint_sets<Index*, Index*> sets(rank.data(), parent.data());
  for (Index v = 0; v < n; ++v) sets.make_set(v);
  for (Index e = 0; e < graph.edges(); ++e) {
    if (edge_removed[e]) continue;
    for (Index v : graph.edge(e)) sets.union_set(graph.edge(e).front(), v);
  }
  Components result;
  std::vector<Index> number(n, -1);
  for (Index v = 0; v < n; ++v) {
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
