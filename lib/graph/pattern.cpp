#include "lib/graph/pattern.h"

#include <algorithm>
#include <numeric>

namespace sg {
namespace {

GraphPattern pattern_of(const Graph& graph, const auto& has_vertex, const auto& has_edge) {
  GraphPattern result;
  result.vertex_variable.assign(graph.vertices(), -1);
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (graph.fixed[v] || !has_vertex(v)) continue;
    result.vertex_variable[v] = static_cast<Index>(result.variable_vertex.size());
    result.variable_vertex.push_back(v);
    result.pattern.dim.push_back(graph.dim(v));
  }
  Pattern& pattern = result.pattern;
  pattern.row_begin.reserve(graph.edges() + 1);
  pattern.row_variables.reserve(graph.edge_vertices.size());
  pattern.row_begin.push_back(0);
  for (Index e = 0; e < graph.edges(); ++e) {
    if (!has_edge(e)) continue;
    const auto row = static_cast<std::ptrdiff_t>(pattern.row_variables.size());
    for (Index v : graph.edge(e)) {
      const Index j = result.vertex_variable[v];
      const auto begin = pattern.row_variables.begin() + row;
      if (j >= 0 &&
          std::find(begin, pattern.row_variables.end(), j) == pattern.row_variables.end()) {
        pattern.row_variables.push_back(j);
      }
    }
    pattern.row_begin.push_back(static_cast<Index>(pattern.row_variables.size()));
  }
  return result;
}

}  // namespace

GraphPattern graph_pattern(const Graph& graph) {
  const auto all = [](Index) { return true; };
  return pattern_of(graph, all, all);
}

GraphPattern graph_pattern(const Graph& graph, const std::vector<bool>& vertex_in,
                           const std::vector<bool>& edge_in) {
  return pattern_of(
      graph, [&](Index v) { return vertex_in[v]; }, [&](Index e) { return edge_in[e]; });
}

Columns columns(const Pattern& pattern) {
  const Index n = pattern.variables();
  Columns result;
  result.begin.assign(n + 1, 0);
  for (Index j : pattern.row_variables) ++result.begin[j + 1];
  std::partial_sum(result.begin.begin(), result.begin.end(), result.begin.begin());
  result.rows.resize(pattern.row_variables.size());
  std::vector<Index> at(result.begin.begin(), result.begin.end() - 1);
  for (Index r = 0; r < pattern.rows(); ++r) {
    for (Index j : pattern.row(r)) result.rows[at[j]++] = r;
  }
  return result;
}

Adjacency adjacency(const Pattern& pattern) {
  const Index n = pattern.variables();
  const Columns column = columns(pattern);
  std::vector<Index> seen(n, -1);
  Adjacency result;
  result.begin.reserve(n + 1);
  result.begin.push_back(0);
  for (Index j = 0; j < n; ++j) {
    seen[j] = j;
    const auto first = static_cast<std::ptrdiff_t>(result.neighbours.size());
    for (Index r : column[j]) {
      for (Index i : pattern.row(r)) {
        if (seen[i] == j) continue;
        seen[i] = j;
        result.neighbours.push_back(i);
      }
    }
    std::sort(result.neighbours.begin() + first, result.neighbours.end());
    result.begin.push_back(static_cast<Index>(result.neighbours.size()));
  }
  return result;
}

}  // namespace sg
