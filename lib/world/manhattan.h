// The Manhattan world (cf. streets.h): poses in SE(2), and loop closures where the robot comes near a
// place of an earlier visit.
#pragma once

#include "lib/world/pose_graph.h"
#include "lib/world/streets.h"

namespace sg::world {

struct Manhattan {
  Index poses = 3500;
  Streets streets = {};
  Index reach = 1;  // metres, along x and along y, from which an earlier pose is recognized
  Index gap = 10;   // poses that lie between the two at least
  double loop_chance = 0.3;  // that it is recognized
  PoseNoise noise{.translation = 0.02, .rotation = 0.005};
  double outliers = 0;  // share of the closures that are false (outliers.h)
  Guess guess = Guess::odometry;
  std::uint64_t seed = 1;
};

// A place remembers the last pose there: a pose has at most (2 reach + 1)^2 loop closures. Time
// O(poses reach^2), memory O(poses + side^2).
PoseGraph<SE2> manhattan(const Manhattan& world);

}  // namespace sg::world
