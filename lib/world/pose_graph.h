// A world of poses only: odometry from each to the next, and loop closures.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "lib/world/odometry.h"

namespace sg::world {

struct Loop {
  Index from;  // the earlier pose
  Index to;
};

// A closure between two poses that measures what a true one, loops[like], does (outliers.h).
struct FalseLoop {
  Index from, to, like;
};

template <class Pose>  // SE2 or SE3
struct PoseGraph {
  Index poses;
  std::function<Pose(Index)> truth;  // of pose 0, 1, ...
  std::vector<Loop> loops;           // by ascending `to`
  PoseNoise noise;                   // of odometry and loop closures
  Guess guess;
  std::uint64_t seed;
  std::vector<FalseLoop> false_loops = {};  // by ascending `to`
};

// What a true closure measures, without noise.
template <class Pose>
Pose measured(const PoseGraph<Pose>& graph, const Loop& loop) {
  return geometry::between(graph.truth(loop.from), graph.truth(loop.to));
}

// VERTEX lines by ascending id from 0 on, then the edges in the order in which a robot would meet
// them: with every pose its odometry first, its loop closures after that, and the false ones last.
// These are comments in the exact copy (odometry.h). Does not flush.
void write_graph(const PoseGraph<SE2>& graph, Copy copy, Out& out);
void write_graph(const PoseGraph<SE3>& graph, Copy copy, Out& out);

}  // namespace sg::world
