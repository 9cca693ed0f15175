// How far a graph's Gaussian is from that of a reference, of which it has some vertices.
#pragma once

#include <optional>

#include "lib/graph/graph.h"

namespace sg::score {

// P is the Gaussian that the reference, linearized at its estimates, has of the graph's variables (covariance S and
// mean); Q the graph's own, linearized at the reference's estimates, too (information W, and mean). The same pose is
// held in both where something has to be.
struct Divergence {
  double
      kld;  // of Kullback and Leibler, of P from Q: the information that is lost where Q is taken for P
  // The largest eigenvalue of W S: in some direction the graph believes in a variance that is so many times too small.
  double overconfidence;
};
// Nothing where a vertex of the graph is none of the reference, or a constant in one of them alone; where one of the two
// leaves variables undetermined, or only one needs a pose to be held; or where an edge has no measurement model.
//
// The trace of W S is the sum of a S a' over the rows a of the graph's Jacobian. Eliminated with the pattern of both,
// the reference has all of S that it takes within its cliques (lib/solve/marginals.h). What its other variables R add to
// its determinant is that of their own information: det = det(W_RR) / det(S).
std::optional<Divergence> divergence(const Graph& graph, const Graph& reference);

}  // namespace sg::score
