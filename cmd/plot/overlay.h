// Another trajectory on a map, and how far its poses are from the graph's.
#pragma once

#include <string>
#include <vector>

#include "cmd/plot/view.h"
#include "lib/score/trajectory.h"

namespace sg::plot {

struct Overlay {
  std::string name;                 // of its file
  std::vector<Position> positions;  // which the map numbers after its vertices
  std::vector<Segment> path;        // from pose to pose, by id
  std::vector<Segment> whiskers;    // from a pose of the graph to its own
  score::TrajectoryError error;     // of the graph's poses
};

// Poses are matched by id. The other trajectory is moved onto the graph's by the rigid motion that leaves the least of the
// squared distances: that of trajectory_error (se), there and back. Throws an input Error where no pose is in both.
Overlay overlay(const Graph& graph, const std::string& name, score::Trajectory other);

}  // namespace sg::plot
