// The simulation of Frey, Steiner and How (Complexity Analysis and Efficient Measurement Selection
// Primitives for High-Rate Graph SLAM, section V): a robot follows a sinusoidal path in the
// horizontal plane, looks ahead, and observes the landmarks in view; they lie in a slab around the
// path. The defaults are in the high-rate regime that the paper is about: some 45 observations a
// landmark and 50 a pose.
#pragma once

#include "lib/world/landmark_graph.h"

namespace sg::world {

struct Sine {
  Index poses = 400;
  double step = 0.25;      // metres along the path from pose to pose
  double amplitude = 15;   // metres
  double wavelength = 60;  // metres
  Index landmarks = 0;     // in the slab, seen or not; 0: `density` of them a square metre
  double density = 0.115;  // of landmarks, a square metre of the slab seen from above
  // Times this, from the path's begin to its end, linear between; empty: 1.
  std::vector<double> profile = {};
  double width = 30;       // landmarks lie within so many metres of the path's axis
  double height = 5;       // and within so many metres above and below it
  Triangulation landmark;  // that a landmark needs to be in the graph
  Sensor sensor = Sensor::mono;
  Optics optics;
  PoseNoise odometry_noise{.translation = 0.01, .rotation = 0.002};
  double guess_noise = 0.1;  // metres
  double outliers = 0;       // share of the observations that are false (outliers.h)
  Guess guess = Guess::odometry;
  std::uint64_t seed = 1;
};

// Time and memory are linear in the length of the path. Throws a computation Error where the slab
// wants more landmarks than a graph can hold.
LandmarkGraph sine(const Sine& world);

}  // namespace sg::world
