// False edges: what a front end adds to a graph that takes one place, or one landmark, for another.
//
// A false closure joins two poses drawn at random, odometry's pairs excepted, and measures what a true closure of the graph,
// drawn at random, measures. A false observation is made by a pose of a landmark that it sees, and said to be of another,
// drawn at random. Both have the noise and the information of true ones, and are wrong by `least_error` standard deviations
// or more: what is nearer by chance is drawn again.
#pragma once

#include "lib/world/landmark_graph.h"
#include "lib/world/pose_graph.h"

namespace sg::world {

constexpr double least_error = 10;

// Adds so many that `share` (0 to below 1) of all closures, or observations, are false. Throws a computation Error where the
// graph has no room for them.
template <class Pose>
PoseGraph<Pose> with_outliers(PoseGraph<Pose> graph, double share);
LandmarkGraph with_outliers(LandmarkGraph graph, double share);

}  // namespace sg::world
