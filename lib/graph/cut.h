// Parts of a graph: which vertices and edges belong to them.
#pragma once

#include <utility>
#include <vector>

#include "lib/graph/graph.h"
#include "lib/graph/replay.h"

namespace sg::graph {

struct Part {
  std::vector<bool> vertex;  // n
  std::vector<bool> edge;    // m
};

// What the first `steps` steps of the replay add.
Part first_steps(const Graph& graph, const PoseIndex& poses, Index steps, int min_obs);

// Poses first..last by index, the edges all of whose poses are among them, and the other vertices
// that those reach.
Part pose_range(const Graph& graph, const PoseIndex& poses, Index first, Index last);

// What is connected to a vertex.
Part component_of(const Graph& graph, Index v);

// The largest component; of several the one with the smallest id.
Part largest_component(const Graph& graph);

// The vertices whose id lies in one of the closed ranges, and the edges among them.
Part of_ids(const Graph& graph, const std::vector<std::pair<Id, Id>>& ranges);

}  // namespace sg::graph
