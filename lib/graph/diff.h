// What one graph has and another has not: vertices by id, edges by type and the ids that they join, parameters by type and
// id. What both have is changed where its numbers differ; for a vertex also where its type does, or where one graph holds
// it fixed, or has no estimate of it. The order of lines and the way numbers are written make no difference.
#pragma once

#include <optional>
#include <vector>

#include "lib/graph/graph.h"

namespace sg::graph {

struct Difference {
  Index a = -1;  // in the first graph: vertex, edge, or place in params; -1: it has none
  Index b = -1;  // in the second
  // Of two that differ in numbers alone: the most that |x - y| / max(1, |x|, |y|) reaches.
  std::optional<double> by = {};
};

struct Diff {
  std::vector<Difference> vertices;  // by ascending id
  std::vector<Difference> edges;  // by the first graph's lines, then those that only the second has
  std::vector<Difference> params;  // by type and id
};

// Numbers differ where that measure is above `tolerance`. Edges of one type between the same vertices (and in the same
// direction) are matched first where they agree to the last digit, then as they come. Both graphs were read with the same
// types. O(n log n).
Diff diff(const Graph& a, const Graph& b, double tolerance = 0);

}  // namespace sg::graph
