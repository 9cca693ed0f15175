// A graph with changes, as its readers will see it.
#pragma once

#include "formats/formats.h"
#include "formats/write.h"

namespace sg::formats {

// Writes the graph with the changes and reads that again; `options` teach the same tags as they did for the graph.
Graph applied(const Graph& graph, Changes changes, ReadOptions options);

}  // namespace sg::formats
