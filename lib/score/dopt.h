// D-optimality: how much information a graph holds at its estimate.
#pragma once

#include "lib/factor/problem.h"

namespace sg::score {

// log det(A^T A) of the problem linearized at `values`, its gauge fixed (problem.h: at the first
// pose unless the file fixes it). -infinity where it is singular: some variable is not determined.
// The order matters to speed alone.
double log_det_information(const factor::Problem& problem, const factor::Values& values,
                           const graph::Order& order);

}  // namespace sg::score
