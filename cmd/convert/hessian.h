// The numbers of the system matrix H = J' W J at a graph's estimates.
#pragma once

#include "formats/write.h"

namespace sg::convert {

// In Matrix Market form, the lower triangle: rows are the scalars of the variables by ascending id, as in formats/mtx.h with
// --scalar. Nothing holds the gauge but what the graph has for it (FIX, priors): of relative measurements alone H is
// singular. Throws what factor::make_problem and factor::linearize throw.
void write_hessian(const Graph& graph, formats::Sink& sink);

}  // namespace sg::convert
