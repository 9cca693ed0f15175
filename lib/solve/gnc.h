// Which measurements to believe, and the estimate that follows from them: graduated non-convexity (Yang, Antonante,
// Tzoumas, Carlone, Graduated Non-Convexity for Robust Spatial Perception: From Non-Minimal Solvers to Global Outlier
// Rejection, 2020) with truncated least squares,
//     minimize  sum over doubtful edges of min(s_e(x), c_e)  +  sum over the others of s_e(x),
// where s_e is an edge's e' W e and c_e its bound. Rounds alternate: the estimate that minimizes sum w_e s_e, and the
// weights that are best at it (Proposition 4),
//     w_e = 0                                  if u >= (mu + 1) / mu,           u = s_e / c_e,
//           1                                  if u <= mu / (mu + 1),
//           sqrt(mu (mu + 1) / u) - mu         between,
// while mu grows by 1.4 a round from where the problem is nearly convex to where the weights are 0 or 1. The paper begins
// with the least squares of all edges, we with the weights at the start. Rounds with weights of 0 and 1 end it, until they
// stay: min over x and min over w in turn, each of which lowers the sum; and before each, landmarks move to where one of
// their edges puts them if that lowers it, too (random sample consensus with all samples of one edge; Fischler, Bolles 1981).
// At last the edges that were left out and are not far off are taken back together, and stay if that lowers the sum.
#pragma once

#include <functional>
#include <vector>

#include "lib/solve/batch.h"

namespace sg::solve {

struct GncOptions {
  BatchOptions batch;          // its loss has no part in this
  std::vector<bool> doubtful;  // m
  std::vector<double> bound;   // m: c_e, above 0 of doubtful edges
};

struct GncResult {
  BatchResult batch;           // of the last round; its iterations are all rounds'
  std::vector<double> weight;  // m: 1 of what is believed, 0 of what is not
};

// Orders the variables of a problem that has some of the rows of the whole one, and plans to eliminate them.
using Planner = std::function<LinearSolver(const factor::Problem&, const factor::LinearSystem&)>;

// Improves `values` in place, and throws as `optimize` does. Closures that a round has no use for are left out of the
// systems, whose elimination gets cheaper as outliers go; other edges without use weigh 1e-8 as much as before, so that
// what hangs on them alone stays determined.
GncResult graduate(const factor::Problem& problem, const Planner& plan, const GncOptions& options,
                   factor::Values& values,
                   const std::function<void(const Iteration&)>& report = {});

}  // namespace sg::solve
