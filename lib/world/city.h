// A grid world with landmarks: a robot walks the streets of a Manhattan world (streets.h) and sees
// the trees of its city. No loop closures: landmarks tie the graph together.
#pragma once

#include "lib/world/landmark_graph.h"
#include "lib/world/streets.h"

namespace sg::world {

struct City {
  Index poses = 3500;
  Streets streets = {};
  Index landmarks = 0;  // uniform in the city, seen or not; 0: one a block
  Triangulation landmark{.observations = 1};
  double detection = 1;  // chance that a landmark in view is observed
  Sensor sensor = Sensor::xy;
  Optics optics{.range = 5, .near = 0.1, .view = 360};
  PoseNoise odometry_noise{.translation = 0.01, .rotation = 0.001};
  double guess_noise = 0.1;  // metres
  double outliers = 0;       // share of the observations that are false (outliers.h)
  Guess guess = Guess::odometry;
  std::uint64_t seed = 1;
};

// Time and memory O(poses + landmarks + landmarks in range of a pose).
LandmarkGraph city(const City& world);

}  // namespace sg::world
