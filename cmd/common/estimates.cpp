#include "cmd/common/estimates.h"

#include <numeric>

#include "lib/text/words.h"

namespace sg {
namespace {

// The numbers of v's line, from the first to the last that an estimate has.
Edit numbers_edit(const Problem& problem, const Values& values, Index v) {
  const Offset line = problem.graph->vertex_line[v];
  const auto text = line_at(*problem.graph, line);
  auto rest = text;
  next_word(rest);
  next_word(rest);
  const auto first = next_word(rest);
  for (int k = 1; k < space_size(problem.space[v]); ++k) next_word(rest);
  const auto at = [&](const char* p) { return line + (p - text.data()); };
  return {at(first.data()), at(rest.data()), estimate_text(problem, values, v)};
}

}  // namespace

Edit vertex_lines(const Problem& problem, const Values& values, std::span<const Index> vertices) {
  const Offset first_edge = problem.graph->edge_line.front();
  Edit edit{first_edge, first_edge, ""};
  for (const Index v : vertices) edit.replacement += vertex_line(problem, values, v);
  return edit;
}

Changes estimate_changes(const Problem& problem, const Values& values,
                         const std::vector<bool>& moved) {
  const Graph& graph = *problem.graph;
  Changes changes = unchanged(graph);
  if (graph.edges_only) {
    std::vector<Index> all(graph.vertices());
    std::iota(all.begin(), all.end(), 0);
    changes.edits.push_back(vertex_lines(problem, values, all));
    return changes;
  }
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (moved[v]) changes.edits.push_back(numbers_edit(problem, values, v));
  }
  return changes;
}

}  // namespace sg
