// Ids in a call: "7", "10:19".
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lib/graph/graph.h"

namespace sg::cmd {

// FIRST:LAST, or one number for both; a usage Error, which begins with the option, for anything else.
std::pair<Id, Id> id_range(const std::string& option, std::string_view text);

// The same of several, each of which has to name a vertex of the graph.
std::vector<std::pair<Id, Id>> ranges_of_vertices(const Graph& graph, const std::string& option,
                                                  const std::vector<std::string>& ids);

}  // namespace sg::cmd
