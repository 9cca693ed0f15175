#include "lib/world/worst.h"

#include <algorithm>
#include <limits>

#include "lib/text/error.h"
#include "lib/world/outliers.h"

namespace sg::world {
namespace {

std::vector<Eigen::Vector3d> landmarks_before(double length, const Worst& world) {
  Random random = random_stream(world.seed, Stream::structure);
  std::vector<Eigen::Vector3d> landmarks(world.landmarks);
  for (auto& l : landmarks) {
    l.x() = rounded(uniform(random, length, 2 * length));
    l.y() = rounded(uniform(random, -length / 4, length / 4));
    l.z() = rounded(uniform(random, -length / 4, length / 4));
  }
  return landmarks;
}

}  // namespace

LandmarkGraph worst(const Worst& world) {
  // Before anything of that size is made.
  if (world.landmarks > 0 && world.poses > std::numeric_limits<Index>::max() / world.landmarks)
    throw text::computation_error("more observations than a graph can hold");
  LandmarkGraph graph = begin_landmark_graph(world);
  const double line = world.step * (world.poses - 1);
  graph.landmarks = landmarks_before(std::max(10.0, line), world);
  for (Index k = 0; k < world.poses; ++k) {
    graph.poses.push_back(rounded(SE2{0, world.step * k - line / 2, 0}));
    for (Index l = 0; l < world.landmarks; ++l) graph.seen.items.push_back(l);
    graph.seen.close();
  }
  return with_outliers(std::move(graph), world.outliers);
}

}  // namespace sg::world
