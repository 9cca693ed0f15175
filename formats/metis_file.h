// METIS's graph file (METIS manual 5.1, section 4.1.1): the block graph of A^T A. Vertices are the
// variables by ascending id, each weighted by its dimension.
#pragma once

#include "formats/convert.h"

namespace sg::formats {

void write_metis(const Graph& graph, const WriteOptions& options, Sink& sink);

}  // namespace sg::formats
