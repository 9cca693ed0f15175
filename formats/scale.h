// Information times a factor, in the text of a graph: nothing else of a line changes.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/write.h"

namespace sg::formats {

// "TAG=X": what the information of edges of this tag is multiplied by.
struct InformationScale {
  graph::TypeIndex type;
  double factor;
};
// Throws a usage Error for text of another form, a tag that no edge has, a type whose lines hold no information that is
// known here, and a factor that is not above zero.
InformationScale parse_scale(const graph::Tags& tags, std::string_view text);

// The graph must outlive the changes.
Changes scaled(const Graph& graph, std::span<const InformationScale> scales);

}  // namespace sg::formats
