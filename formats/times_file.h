// A table of times: a line "ID TIME" a vertex, whatever else follows; a headline, blank lines and comments (#) may stand in
// it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lib/graph/graph.h"

namespace sg::formats {

// The time of every vertex of the graph, as it is written; empty where the table has none. Ids that the graph does not have
// are passed over. Throws an input Error of `file` for a line that is no id and time, and for an id that comes twice.
std::vector<std::string> parse_times(std::string_view text, const std::string& file,
                                     const Graph& graph);

}  // namespace sg::formats
