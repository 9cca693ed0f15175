#include "lib/graph/pattern.h"

#include <algorithm>
#include <cassert>

namespace sg::graph {
namespace {

Lists<> fixed_vertices(const Graph& graph, const auto& has_vertex, const auto& has_edge) {
  Lists<> result;
  std::vector<Index> number(graph.vertices(), -1);
  Index count = 0;
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (graph.fixed[v] && has_vertex(v)) number[v] = count++;
  }
  if (count == 0) return result;
  for (Index e = 0; e < graph.edges(); ++e) {
    if (!has_edge(e)) continue;
    for (Index v : graph.edge(e)) {
      const Index k = number[v];
      const auto row = result.open();
      if (k >= 0 && std::ranges::find(row, k) == row.end()) result.items.push_back(k);
    }
    result.close();
  }
  return result;
}

GraphPattern pattern_of(const Graph& graph, const auto& has_vertex, const auto& has_edge) {
  GraphPattern result;
  result.vertex_variable.assign(graph.vertices(), -1);
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (graph.fixed[v] || !has_vertex(v)) continue;
    result.vertex_variable[v] = static_cast<Index>(result.variable_vertex.size());
    result.variable_vertex.push_back(v);
    result.pattern.dim.push_back(graph.dim(v));
  }
  Lists<>& rows = result.pattern.rows;
  rows.begin.reserve(graph.edges() + 1);
  rows.items.reserve(graph.edge_vertices.items.size());
  for (Index e = 0; e < graph.edges(); ++e) {
    if (!has_edge(e)) continue;
    for (Index v : graph.edge(e)) {
      const Index j = result.vertex_variable[v];
      const auto row = rows.open();
      if (j >= 0 && std::find(row.begin(), row.end(), j) == row.end()) rows.items.push_back(j);
    }
    rows.close();
  }
  result.pattern.constants = fixed_vertices(graph, has_vertex, has_edge);
  return result;
}

}  // namespace

bool is_permutation(std::span<const Index> order, Index n) {
  std::vector<bool> seen(n, false);
  for (Index j : order) {
    if (j < 0 || j >= n || seen[j]) return false;
    seen[j] = true;
  }
  return static_cast<Index>(order.size()) == n;
}

GraphPattern graph_pattern(const Graph& graph) {
  const auto all = [](Index) { return true; };
  return pattern_of(graph, all, all);
}

GraphPattern graph_pattern(const Graph& graph, const std::vector<bool>& vertex_in,
                           const std::vector<bool>& edge_in) {
  assert(vertex_in.size() == graph.id.size() && edge_in.size() == graph.edge_type.size());
  return pattern_of(
      graph, [&](Index v) { return vertex_in[v]; }, [&](Index e) { return edge_in[e]; });
}

Adjacency adjacency(const Pattern& pattern) {
  const Index n = pattern.variables();
  std::size_t longest = 0;
  for (Index r = 0; r < pattern.rows.size(); ++r)
    longest = std::max(longest, pattern.rows[r].size());
  if (longest > 0)
    item_count(longest * (longest - 1));  // at least; not to find out with memory full
  const Lists<> column = columns(pattern);
  std::vector<Index> seen(n, -1);
  Adjacency result;
  result.begin.reserve(n + 1);
  for (Index j = 0; j < n; ++j) {
    seen[j] = j;
    for (Index r : column[j]) {
      for (Index i : pattern.rows[r]) {
        if (seen[i] == j) continue;
        seen[i] = j;
        result.items.push_back(i);
      }
    }
    std::ranges::sort(result.open());
    result.close();
  }
  return result;
}

}  // namespace sg::graph
