// Time in a graph (DESIGN: the model): poses in order of id, what an edge is to them, and the steps
// of a replay.
#pragma once

#include <functional>
#include <vector>

#include "lib/graph/graph.h"

namespace sg::graph {

enum class EdgeRole : std::uint8_t {
  odometry,      // joins two poses of consecutive index
  loop_closure,  // joins any other two poses
  observation,   // joins poses and landmarks
  other,         // unary edges, edges among landmarks, edges with a vertex that is neither
};

struct PoseIndex {
  std::vector<Index> pose;   // vertex of every pose, by ascending id
  std::vector<Index> index;  // pose index of every vertex, -1 of what is no pose
};
PoseIndex pose_index(const Graph& graph);

EdgeRole edge_role(const Graph& graph, const PoseIndex& poses, Index e);
std::vector<EdgeRole> edge_roles(const Graph& graph, const PoseIndex& poses);

// First pose index of every trajectory segment, ascending. A segment ends where no odometry edge
// leads on.
std::vector<Index> segments(const Graph& graph, const PoseIndex& poses);

// The replay. Step k adds pose k and every edge whose last pose is k; a landmark enters with the
// step that gives it its min_obs-th observation and brings its earlier observations along. Vertices
// and edges without a pose: a vertex enters with the first edge that reaches it, an edge without
// pose enters as soon as all its vertices are there. Vertices or edges that never enter (a landmark
// with fewer observations) have step -1. Sorted by step they are grouped(vertex_step, steps) and
// grouped(edge_step, steps).
struct Replay {
  Index steps = 0;                 // number of poses
  std::vector<Index> vertex_step;  // n
  std::vector<Index> edge_step;    // m
};
Replay replay(const Graph& graph, const PoseIndex& poses, int min_obs = 1);

// What is in after step `step`: vertices and edges, marked and counted.
struct Grown {
  Index step;
  std::vector<bool> vertex_in, edge_in;
  Index vertices = 0, edges = 0;
};
// Shows the growing graph after every step, as long as that says to go on.
void grow(const Graph& graph, const Replay& replay, const std::function<bool(const Grown&)>& show);

}  // namespace sg::graph
