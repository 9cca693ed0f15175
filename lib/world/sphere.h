// A robot winds up a sphere from pole to pole, as in the graph called sphere2500: each pose closes a
// loop with the one that lies a turn before it.
#pragma once

#include "lib/world/pose_graph.h"

namespace sg::world {

struct Sphere {
  Index poses = 2500;
  Index turn = 0;          // poses a turn; 0: the square root of `poses`
  double radius = 0;       // metres; 0: so that poses on the equator are a metre apart
  double loop_chance = 1;  // that a loop closure is found
  PoseNoise noise{.translation = 0.05, .rotation = 0.01};
  double outliers = 0;  // share of the closures that are false (outliers.h)
  Guess guess = Guess::odometry;
  std::uint64_t seed = 1;
};

PoseGraph<SE3> sphere(const Sphere& world);

}  // namespace sg::world
