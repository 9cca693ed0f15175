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

// Marks on types of vertices and edges, by their places in Tags.
struct Types {
  std::vector<bool> vertex, edge;
};

// The vertices of these types and the edges among them, the edges of these types and the vertices that they join.
Part of_types(const Graph& graph, const Types& types);

// All but the edges of these types and the vertices of these types with their edges; of what is no pose, what
// has lost its last edge goes as well.
Part without_types(const Graph& graph, const Types& types);

}  // namespace sg::graph
