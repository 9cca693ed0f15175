#include "lib/world/city.h"

#include <algorithm>
#include <cmath>

namespace sg {
namespace {

// The landmarks of a square, sorted by the cells of a grid.
struct Cells {
  double size;               // of a cell, metres
  Index across;              // cells along one side
  std::vector<Index> begin;  // across^2 + 1, into landmarks
  std::vector<Index> landmarks;

  Index along(double x) const {
    return std::clamp(static_cast<Index>(std::floor(x / size)), 0, across - 1);
  }
  Index of(const Eigen::Vector3d& point) const {
    return along(point.y()) * across + along(point.x());
  }
};

Cells sorted_by_cell(const std::vector<Eigen::Vector3d>& points, double side, double range) {
  Cells cells;
  cells.size = std::max(range, side / 4096);
  cells.across = static_cast<Index>(side / cells.size) + 1;
  cells.begin.assign(static_cast<std::size_t>(cells.across) * cells.across + 1, 0);
  for (const auto& point : points) ++cells.begin[cells.of(point) + 1];
  for (std::size_t c = 1; c < cells.begin.size(); ++c) cells.begin[c] += cells.begin[c - 1];
  cells.landmarks.resize(points.size());
  std::vector<Index> next(cells.begin.begin(), cells.begin.end() - 1);
  for (std::size_t l = 0; l < points.size(); ++l) {
    cells.landmarks[next[cells.of(points[l])]++] = static_cast<Index>(l);
  }
  return cells;
}

// Calls use(landmark) for every landmark that may be within range.
template <class Use>
void for_each_near(const Cells& cells, const SE2& pose, double range, const Use& use) {
  for (Index row = cells.along(pose.y - range); row <= cells.along(pose.y + range); ++row) {
    const Index from = row * cells.across + cells.along(pose.x - range);
    const Index to = row * cells.across + cells.along(pose.x + range);
    for (Index i = cells.begin[from]; i < cells.begin[to + 1]; ++i) use(cells.landmarks[i]);
  }
}

std::vector<Eigen::Vector3d> trees(const City& world, Index side, Random& random) {
  const Index blocks = side / world.streets.block;
  std::vector<Eigen::Vector3d> points(world.landmarks > 0 ? world.landmarks : blocks * blocks);
  for (auto& point : points) {
    const double x = uniform(random, 0, side), y = uniform(random, 0, side);
    point = {rounded(x), rounded(y), 0};
  }
  return points;
}

void look(const City& world, double side, Random& random, LandmarkGraph& graph) {
  const Cells cells = sorted_by_cell(graph.landmarks, side, world.optics.range);
  for (const SE2& pose : graph.poses) {
    const SE2 robot = inverse(pose);
    for_each_near(cells, pose, world.optics.range, [&](Index l) {
      Eigen::Vector3d point(0, 0, 0);
      point.head<2>() = act(robot, graph.landmarks[l].head<2>());
      if (!sees(world.optics, world.sensor, point)) return;
      if (chance(random, world.detection)) graph.seen.push_back(l);
    });
    end_observations(graph);
  }
}

}  // namespace

LandmarkGraph city(const City& world) {
  Random random = random_stream(world.seed, Stream::structure);
  const Index side = side_of(world.streets, world.poses);
  LandmarkGraph graph = begin_landmark_graph(world);
  graph.poses.reserve(world.poses);
  for (const StreetPose& at : street_walk(world.streets, world.poses, random)) {
    graph.poses.push_back(pose(at));
  }
  graph.landmarks = trees(world, side, random);
  look(world, side, random, graph);
  keep_triangulated(graph, world.landmark);
  return graph;
}

}  // namespace sg
