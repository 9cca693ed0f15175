#include "cmd/common/ranges.h"

#include <algorithm>

#include "lib/text/words.h"

namespace sg::cmd {

Index vertex_of(const Graph& graph, const std::string& option, Id id) {
  const auto v = graph::find_vertex(graph, id);
  if (!v) throw text::usage_error(option + ": the graph has no vertex " + std::to_string(id));
  return *v;
}

std::pair<Id, Id> parse_range(const std::string& option, std::string_view text) {
  const auto colon = text.find(':');
  const auto first = text::parse<Id>(text.substr(0, colon));
  const auto last = colon == text.npos ? first : text::parse<Id>(text.substr(colon + 1));
  if (!first || !last || *first < 0 || *last < *first)
    throw text::usage_error(option + " " + std::string(text) + " is no range FIRST:LAST");
  return {*first, *last};
}

std::vector<std::pair<Id, Id>> parse_ranges(const std::string& option,
                                            const std::vector<std::string>& texts) {
  std::vector<std::pair<Id, Id>> ranges;
  ranges.reserve(texts.size());
  for (const auto& text : texts) ranges.push_back(parse_range(option, text));
  return ranges;
}

std::vector<std::pair<Id, Id>> ranges_of_vertices(const Graph& graph, const std::string& option,
                                                  const std::vector<std::string>& texts) {
  auto ranges = parse_ranges(option, texts);
  for (std::size_t k = 0; k < texts.size(); ++k) {
    const auto there = std::ranges::lower_bound(graph.id, ranges[k].first);
    if (there == graph.id.end() || *there > ranges[k].second)
      throw text::usage_error(option + " " + texts[k] + ": the graph has no such vertex");
  }
  return ranges;
}

}  // namespace sg::cmd
