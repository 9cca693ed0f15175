// Whether a map shows where things are, or estimates that nobody has solved yet.
#pragma once

#include <string>

#include "lib/graph/graph.h"

namespace sg::plot {

// Of odometry, loop closures and observations the kind that the estimates contradict most, by the median of e' W e per
// degree of freedom over its edges: around 1/2 where estimates are solved and the noise is as the file says, and little
// larger where some edges are false, since half of them would have to be.
struct Contradiction {
  std::string kind;   // "loop closures"
  double median = 0;  // infinity where half of them have no finite error
};
// Nothing of it where the graph has types or lines that no model takes.
Contradiction contradiction(const Graph& graph);

// What to do about it, as a line below a map's title; empty where the estimates look solved.
constexpr double most_of_solved = 25;  // 5 standard deviations
std::string unsolved_hint(const Graph& graph);

}  // namespace sg::plot
