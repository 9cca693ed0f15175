// Poses on the points of a cubic grid, a metre apart. A robot sweeps it line by line, layer by layer,
// and closes loops with the neighbours it passed, as in the graphs called tinyGrid3D, smallGrid3D
// and grid3D; or it walks at random, and closes loops with what it finds on the points around it.
#pragma once

#include "lib/world/pose_graph.h"

namespace sg::world {

enum class GridWalk { sweep, random };

struct Grid3d {
  Index poses = 8000;
  GridWalk walk = GridWalk::sweep;
  Index side = 0;  // points along an edge of the cube; 0: sweep fills it, random comes by
                   // every point about twice
  double loop_chance = 0.95;  // that a neighbour is recognized
  PoseNoise noise{.translation = 0.05, .rotation = 0.01};
  double outliers = 0;  // share of the closures that are false (outliers.h)
  Guess guess = Guess::odometry;
  std::uint64_t seed = 1;
};

// With random walks a point remembers the last pose there. A sweep of more poses than points goes
// on above the cube.
PoseGraph<SE3> grid3d(const Grid3d& world);

}  // namespace sg::world
