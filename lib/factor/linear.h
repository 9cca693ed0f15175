// The models of linear factors (lib/graph/linear.h): whitened errors U (y - d) of any number of vertices, and their
// slopes, U the root of the line's information.
//
// Their constants say of what vertices they are: dim, the number of vertices, the space of each, then the
// linearization point of each (EDGE_LINEAR_RELATIVE: the first one's, and the others as that sees them), then d.
#pragma once

#include <span>
#include <string>

#include "lib/factor/model.h"
#include "lib/graph/linear.h"

namespace sg::factor {

// Why a factor of this type cannot join such vertices, as the end of a sentence; empty where it can.
std::string misfit(graph::EdgeTag type, std::span<const graph::Space> ends);

// How many constants a factor keeps.
int linear_constants(const graph::LinearSize& size, std::span<const graph::Space> ends);
// The numbers x and d of a line to constants. False for a quaternion of length zero.
bool prepare_linear(graph::EdgeTag type, std::span<const graph::Space> ends, const double* numbers,
                    double* constants);
int linear_dim(const double* constants);

Model linear_model(graph::EdgeTag type);

}  // namespace sg::factor
