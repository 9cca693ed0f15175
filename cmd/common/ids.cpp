#include "cmd/common/ids.h"

#include <algorithm>

#include "lib/text/error.h"
#include "lib/text/words.h"

namespace sg::cmd {

std::pair<Id, Id> id_range(const std::string& option, std::string_view text) {
  const auto colon = text.find(':');
  const auto first = text::parse<Id>(text.substr(0, colon));
  const auto last = colon == text.npos ? first : text::parse<Id>(text.substr(colon + 1));
  if (!first || !last || *first < 0 || *last < *first)
    throw text::usage_error(option + " " + std::string(text) + " is no range FIRST:LAST");
  return {*first, *last};
}

std::vector<std::pair<Id, Id>> ranges_of_vertices(const Graph& graph, const std::string& option,
                                                  const std::vector<std::string>& ids) {
  std::vector<std::pair<Id, Id>> ranges;
  ranges.reserve(ids.size());
  for (const auto& text : ids) {
    const auto [first, last] = id_range(option, text);
    const auto there = std::ranges::lower_bound(graph.id, first);
    if (there == graph.id.end() || *there > last)
      throw text::usage_error(option + " " + text + ": the graph has no such vertex");
    ranges.emplace_back(first, last);
  }
  return ranges;
}

}  // namespace sg::cmd
