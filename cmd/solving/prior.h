// sg-solve's --prior: what a call says of where vertices are, beside the graph's own edges.
#pragma once

#include <span>
#include <string>

#include "formats/formats.h"
#include "formats/write.h"

namespace sg::solving {

// The graph with an edge for each of these, "ID:NUMBERS:SIGMAS", behind its own. NUMBERS are a VERTEX line's, or those of
// its position alone, or nothing: where the file has the vertex. SIGMAS are standard deviations in metres and radians:
// one, or one for each direction of a step. Throws a usage Error for what is no such text, and for a vertex that is not
// there or that has no prior.
Graph with_priors(const Graph& graph, std::span<const std::string> priors,
                  const formats::ReadOptions& options);

// Leaves out of what is written what with_priors() has added to a text that was `own` bytes long.
void leave_out_priors(const Graph& graph, Offset own, formats::Changes& changes);

}  // namespace sg::solving
