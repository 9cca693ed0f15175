// A robot winds around a torus until it is back at its start, as in the graph called torus3D: poses
// close loops with those that lie a turn around the tube before them, the last turn with the first.
#pragma once

#include "lib/world/pose_graph.h"

namespace sg::world {

struct Torus {
  Index poses = 5000;
  Index turn = 0;            // poses a turn around the tube; 0: the root of half of `poses`
  double tube = 0;           // metres, radius of the tube; 0: poses on it a metre apart
  double ratio = 2;          // radius of the torus, its centre to the tube's, in radii of the tube
  double loop_chance = 0.8;  // that a loop closure is found
  PoseNoise noise{.translation = 0.05, .rotation = 0.01};
  double outliers = 0;  // share of the closures that are false (outliers.h)
  Guess guess = Guess::odometry;
  std::uint64_t seed = 1;
};

PoseGraph<SE3> torus(const Torus& world);

}  // namespace sg::world
