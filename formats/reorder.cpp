#include "formats/reorder.h"

#include <algorithm>

#include "lib/text/words.h"

namespace sg::formats {
namespace {

// The first line that names a vertex; the end of the text without one.
Offset first_mention(const Graph& graph) {
  auto first = static_cast<Offset>(graph.text.view.size());
  if (graph.edges() > 0) first = std::min(first, graph.edge_line.front());
  if (!graph.fix_lines.empty()) first = std::min(first, graph.fix_lines.front());
  return first;
}

}  // namespace

std::vector<Edit> reordered(const Graph& graph, const std::vector<Index>& order) {
  std::vector<Edit> edits;
  const std::vector<Index> places = graph::file_order(graph);
  const Offset mention = first_mention(graph);
  const auto line = [&](Index v) { return graph.vertex_line[v]; };
  if (order.empty() || (order == places && line(places.back()) < mention)) return edits;
  std::string lines;
  for (const Index v : order) {
    const auto [begin, end] = vertex_extent(graph, v);
    lines += graph.text.view.substr(begin, end - begin);
    if (lines.back() != '\n') lines += '\n';
  }
  const Offset place = std::min(line(places.front()), mention);
  edits.push_back({place, place, std::move(lines)});
  for (const Index v : places) {
    const auto [begin, end] = vertex_extent(graph, v);
    if (edits.size() > 1 && edits.back().end == begin) {
      edits.back().end = end;
    } else {
      edits.push_back({begin, end, ""});
    }
  }
  return edits;
}

void mark_stale_orders(const Graph& graph, std::string_view command, Changes& changes) {
  if (graph.order_method.empty()) return;
  for (const Offset line : graph.order_lines) {
    auto end = line + static_cast<Offset>(graph::line_at(graph, line).size());
    while (text::is_blank(graph.text.view[end - 1])) --end;
    if (graph.text.view[end - 1] == ',') continue;
    changes.edits.push_back({end, end, ", until " + std::string(command) + " changed the graph"});
  }
}

}  // namespace sg::formats
