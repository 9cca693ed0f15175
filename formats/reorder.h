// VERTEX lines in another order.
#pragma once

#include <vector>

#include "formats/write.h"

namespace sg::formats {

// The edits that put the VERTEX lines into `order`, a permutation of the vertices: where the file's
// k-th VERTEX line stands comes that of order[k], with the data lines that belong to it. Every
// other line stays where it is.
std::vector<Edit> reordered(const Graph& graph, const std::vector<Index>& order);

}  // namespace sg::formats
