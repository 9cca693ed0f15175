// How well a graph holds together, from its structure and its edges' weights alone.
#pragma once

#include <optional>

#include "lib/graph/graph.h"
#include "lib/trees/tree_weights.h"

namespace sg::trees {

// log of the weighted number of spanning trees (Kirchhoff: the determinant of the Laplacian without
// one node); under TreeWeights::dopt the sum over its layers, times their multiplicities.
// -infinity where there is none: the graph falls into parts. An edge of more than two vertices
// links its first to each of the others. Nodes that a layer has no link for (landmarks, in
// rotation) do not belong to it, unless it has no links at all.
double log_trees(const Graph& graph, TreeWeights weights);

// Algebraic connectivity: the second smallest eigenvalue of the weighted Laplacian (Fiedler 1973),
// 0 for a graph in parts. From dense eigenvalues where the graph is small, otherwise by a Lanczos
// iteration on the Laplacian's pseudo-inverse (Spectra), to a relative residual of 1e-10. Nothing
// for a graph of less than two nodes, and under TreeWeights::dopt, which has two Laplacians. Throws
// a computation Error if the iteration does not converge.
std::optional<double> algebraic_connectivity(const Graph& graph, TreeWeights weights);

}  // namespace sg::trees
