// The graph of the paper's analysis (Frey, Steiner, How, section III-A): every landmark is observed
// from every pose, the worst case of landmark SLAM without loop closures.
//
// Poses stand in a line and look across it; landmarks lie before them, at once to twice the line's
// length (10 metres at least), where all of them are in every pose's 90-degree view.
#pragma once

#include "lib/world/landmark_graph.h"

namespace sg::world {

struct Worst {
  Index poses = 20;
  Index landmarks = 50;
  double step = 0.5;  // metres from pose to pose
  Sensor sensor = Sensor::mono;
  Optics optics;  // its noise; everything is in view
  PoseNoise odometry_noise{.translation = 0.01, .rotation = 0.002};
  double guess_noise = 0.1;  // metres
  double outliers = 0;       // share of the observations that are false (outliers.h)
  Guess guess = Guess::odometry;
  std::uint64_t seed = 1;
};

LandmarkGraph worst(const Worst& world);

}  // namespace sg::world
