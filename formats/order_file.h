// Elimination orders as text: a vertex id in the first column of every line. Blank lines and
// comments are passed over, and so is the headline of a table.
#pragma once

#include <string>

#include "lib/graph/graph.h"
#include "lib/graph/pattern.h"

namespace sg::formats {

// Every variable of the graph has to be named once; a fixed vertex may be, and is passed over.
// Throws an input Error with the line of `file` that is wrong.
graph::Order parse_order(std::string_view text, const std::string& file, const Graph& graph,
                         const graph::GraphPattern& variables);

}  // namespace sg::formats
