#include "formats/reorder.h"

namespace sg::formats {
namespace {

std::string_view lines_of(const Graph& graph, Index v) {
  const auto [begin, end] = vertex_extent(graph, v);
  return graph.text.view.substr(static_cast<std::size_t>(begin),
                                static_cast<std::size_t>(end - begin));
}

// The newline stays with the place: the last line of a file may lack it.
std::string with_end_of(std::string_view lines, std::string_view place) {
  std::string result(lines.substr(0, lines.size() - (lines.ends_with('\n') ? 1 : 0)));
  if (place.ends_with('\n')) result += '\n';
  return result;
}

}  // namespace

std::vector<Edit> reordered(const Graph& graph, const std::vector<Index>& order) {
  const std::vector<Index> places = graph::file_order(graph);
  std::vector<Edit> edits;
  edits.reserve(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (places[k] == order[k]) continue;
    const auto [begin, end] = vertex_extent(graph, places[k]);
    edits.push_back(
        {begin, end, with_end_of(lines_of(graph, order[k]), lines_of(graph, places[k]))});
  }
  return edits;
}

}  // namespace sg::formats
