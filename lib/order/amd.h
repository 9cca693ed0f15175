// Approximate minimum degree of a graph that is at hand (Amestoy, Davis, Duff, ACM TOMS 30, 2004), every vertex weighing
// one.
#pragma once

#include <vector>

#include "lib/graph/pattern.h"

namespace sg::order {

// CAMD where some vertices come last. Throws a computation Error where the library gives up.
graph::Order minimum_degree(const graph::Adjacency& graph, const std::vector<Index>& last = {});

}  // namespace sg::order
