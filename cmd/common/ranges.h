// Vertices that a call names: by an id, by ranges of ids, "7" or "3:9", and lists of them.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lib/graph/graph.h"

namespace sg::cmd {

// Throws a usage Error where the graph has no such vertex.
Index vertex_of(const Graph& graph, const std::string& option, Id id);

// A closed range; throws a usage Error for text that is none.
std::pair<Id, Id> parse_range(const std::string& option, std::string_view text);
std::vector<std::pair<Id, Id>> parse_ranges(const std::string& option,
                                            const std::vector<std::string>& texts);

// The same where each has to hold a vertex of the graph.
std::vector<std::pair<Id, Id>> ranges_of_vertices(const Graph& graph, const std::string& option,
                                                  const std::vector<std::string>& texts);

}  // namespace sg::cmd
