#include "cmd/common/estimates.h"

#include <numeric>

#include "lib/text/words.h"

namespace sg::cmd {
namespace {

// The numbers of v's line, from the first to the last that an estimate has.
formats::Edit numbers_edit(const factor::Problem& problem, const factor::Values& values, Index v) {
  const Offset line = problem.graph->vertex_line[v];
  const auto text = graph::line_at(*problem.graph, line);
  auto rest = text;
  text::next_word(rest);
  text::next_word(rest);
  const auto first = text::next_word(rest);
  for (int k = 1; k < graph::space_size(problem.space[v]); ++k) text::next_word(rest);
  const auto at = [&](const char* p) { return line + (p - text.data()); };
  return {at(first.data()), at(rest.data()), factor::estimate_text(problem, values, v)};
}

}  // namespace

formats::Edit vertex_lines(const factor::Problem& problem, const factor::Values& values,
                           std::span<const Index> vertices) {
  const Offset first_edge = problem.graph->edge_line.front();
  formats::Edit edit{first_edge, first_edge, ""};
  for (const Index v : vertices) edit.replacement += factor::vertex_line(problem, values, v);
  return edit;
}

formats::Changes estimate_changes(const factor::Problem& problem, const factor::Values& values,
                                  const std::vector<bool>& moved) {
  const Graph& graph = *problem.graph;
  formats::Changes changes = formats::unchanged(graph);
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

}  // namespace sg::cmd
