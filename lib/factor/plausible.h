// What the measurements of a graph say of each other, beyond what a line can be checked for alone.
#pragma once

#include "lib/graph/check.h"

namespace sg::factor {

// Nothing where the graph has types or lines that no model takes.
//
//   landmarks   that their observations, linearized at the file's estimates, leave undetermined: rays
//               that are parallel, a bearing from far along it. By the eigenvalues of the sum of J' W J:
//               an error where the least is below 1e-14 of the largest, a warning below 1e-10.
//   scales      information of one edge type that differs by more than 1e12 between two edges.
//   closures    that the odometry between contradicts by 6 standard deviations: composed, it ends
//               elsewhere, or all of it is shorter than the closure is long. The deviation sums those of
//               the steps, rotations by the distance that they act at (first order, independent steps).
graph::Findings check_plausible(const Graph& graph);

}  // namespace sg::factor
