// Ranges of ids in a call: "7" or "3:9", and lists of them.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lib/graph/graph.h"

namespace sg::cmd {

// A closed range; throws a usage Error for text that is none.
std::pair<Id, Id> parse_range(const std::string& option, std::string_view text);
std::vector<std::pair<Id, Id>> parse_ranges(const std::string& option,
                                            const std::vector<std::string>& texts);

}  // namespace sg::cmd
