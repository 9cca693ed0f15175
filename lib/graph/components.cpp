#include "lib/graph/components.h"

#include <boost/pending/disjoint_sets.hpp>
#include <cassert>
#include <numeric>

namespace sg::graph {
namespace {

boost::disjoint_sets<Index*, Index*> boost_sets(DisjointSets& sets) {
  return {sets.rank.data(), sets.parent.data()};
}

}  // namespace

DisjointSets::DisjointSets(Index count) : rank(count), parent(count) {
  std::iota(parent.begin(), parent.end(), 0);
}

Index find(DisjointSets& sets, Index k) {
  return boost_sets(sets).find_set(k);
}

bool join(DisjointSets& sets, Index a, Index b) {
  a = find(sets, a);
  b = find(sets, b);
  if (a != b) boost_sets(sets).link(a, b);
  return a != b;
}

Components components(const Graph& graph, const std::vector<bool>& edge_removed) {
  return components(graph.edge_vertices, graph.vertices(), edge_removed);
}

Components components(const Lists<>& lists, Index count, const std::vector<bool>& list_removed) {
  assert(list_removed.empty() || std::ssize(list_removed) == lists.size());
  DisjointSets sets(count);
  for (Index k = 0; k < lists.size(); ++k) {
    if (!list_removed.empty() && list_removed[k]) continue;
    for (Index v : lists[k]) join(sets, lists[k].front(), v);
  }
  Components result;
  std::vector<Index> number(count, -1);
  for (Index v = 0; v < count; ++v) {
    Index& component = number[find(sets, v)];
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
