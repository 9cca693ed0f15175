#include "formats/reorder.h"

#include <algorithm>

namespace sg::formats {
namespace {

// Where the first line stands that defines a vertex or names one.
Offset first_mention(const Graph& graph) {
  Offset first = graph.vertex_line[graph::file_order(graph).front()];
  if (graph.edges() > 0) first = std::min(first, graph.edge_line.front());
  if (!graph.fix_lines.empty()) first = std::min(first, graph.fix_lines.front());
  return first;
}

// Whether the VERTEX lines stand in this order, and before all that names them.
bool stands(const Graph& graph, const std::vector<Index>& order) {
  if (order != graph::file_order(graph)) return false;
  const Offset last = graph.vertex_line[order.back()];
  return (graph.edges() == 0 || last < graph.edge_line.front()) &&
         (graph.fix_lines.empty() || last < graph.fix_lines.front());
}

}  // namespace

std::vector<Edit> reordered(const Graph& graph, const std::vector<Index>& order) {
  std::vector<Edit> edits;
  if (order.empty() || stands(graph, order)) return edits;
  std::string lines;
  for (const Index v : order) {
    const auto [begin, end] = vertex_extent(graph, v);
    lines += graph.text.view.substr(begin, end - begin);
    if (lines.back() != '\n') lines += '\n';
  }
  const Offset place = first_mention(graph);
  edits.push_back({place, place, std::move(lines)});
  for (const Index v : graph::file_order(graph)) {
    const auto [begin, end] = vertex_extent(graph, v);
    if (edits.size() > 1 && edits.back().end == begin) {
      edits.back().end = end;
    } else {
      edits.push_back({begin, end, ""});
    }
  }
  return edits;
}

}  // namespace sg::formats
