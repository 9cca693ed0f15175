// What is in a graph, in numbers.
#pragma once

#include <cstdint>
#include <optional>

#include "lib/graph/graph.h"

namespace sg::graph {

struct Summary {
  Index poses = 0;
  Index landmarks = 0;
  Index others = 0;  // vertices that are neither
  Index fixed = 0;
  Index odometry = 0;
  Index loop_closures = 0;
  Index observations = 0;
  Index other_edges = 0;
  Index segments = 0;       // of the trajectory
  Index components = 0;     // connected parts
  Index isolated = 0;       // vertices without an edge
  Index max_degree = 0;     // edges of the vertex with most
  std::int64_t dim = 0;     // tangent dimensions of all variables: columns of the scalar system
  std::int64_t rows = 0;    // dimensions of all measurements; edges of unknown dimension count none
  std::int64_t sights = 0;  // pairs of an observation and a landmark in it
};
Summary summarize(const Graph& graph);

// Mean number of edges to poses that a landmark has; nothing without landmarks.
std::optional<double> average_observations(const Graph& graph);

}  // namespace sg::graph
