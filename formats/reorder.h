// VERTEX lines in another order.
#pragma once

#include <vector>

#include "formats/write.h"

namespace sg::formats {

// The edits that put the VERTEX lines into `order`, a permutation of the vertices of a graph that has
// them: all where the first of them stood, or before the first line that names one, each with the data
// lines that belong to it. A reader in one pass then knows every vertex that a line names. Every other
// line stays where it is; nothing to do where all is so already.
std::vector<Edit> reordered(const Graph& graph, const std::vector<Index>& order);

// An ordering was made for the structure that it found: its comment says until which command changed that.
void mark_stale_orders(const Graph& graph, std::string_view command, Changes& changes);

}  // namespace sg::formats
