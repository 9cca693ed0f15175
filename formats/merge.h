// Several graphs as one: the ids that their vertices and parameters get, and the text of them all.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "formats/renumber.h"

namespace sg::formats {

enum class MergedIds : std::uint8_t {
  offset,  // those of a graph follow those of the graphs before it: the first one keeps its own
  prefix,  // the number of the graph, 1, 2, ..., in front of as many digits as the largest id has
  keep,    // as they are
};

struct MergeOptions {
  MergedIds ids = MergedIds::offset;
  // Closed ranges of ids that name one vertex wherever they stand, and stay as they are. Its line is that of the first
  // graph that has one.
  std::vector<std::pair<Id, Id>> shared;
};

// What to change of each graph, so that their texts one after the other are one graph. A parameter that an earlier graph has
// with the same numbers is that one; else it keeps its id if that is free, and gets the next free one if not. Orders that
// sg-order left are marked as stale in the name of `who`.
//
// Throws an input Error where a vertex is of two kinds, an id stands in two graphs though it is not shared, an id would
// pass 2^63 - 1, or some graphs have VERTEX lines and others have none. The graphs have no lines that reading left out.
std::vector<Changes> merged(std::span<const Graph> graphs, const MergeOptions& options,
                            std::string_view who);

// Their texts one after the other, changed; `comment` goes to the head.
void write_merged(std::span<const Graph> graphs, std::vector<Changes> changes,
                  std::string_view comment, Sink& sink);

}  // namespace sg::formats
