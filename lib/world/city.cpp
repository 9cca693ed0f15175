#include "lib/world/city.h"

#include <algorithm>
#include <cmath>

#include "lib/world/outliers.h"

namespace sg::world {
namespace {

// The landmarks of a square, sorted by the cells of a grid.
struct Grid {
  double size;               // of a cell, metres
  Index across;              // cells along one side
  graph::Lists<> landmarks;  // of every cell, row by row

  Index along(double x) const {
    return std::clamp(static_cast<Index>(std::floor(x / size)), 0, across - 1);
  }
  Index cell(const Eigen::Vector3d& point) const {
    return along(point.y()) * across + along(point.x());
  }
};

Grid sorted_by_cell(const std::vector<Eigen::Vector3d>& points, double side, double range) {
  Grid grid;
  grid.size = std::max(range, side / 4096);
  grid.across = static_cast<Index>(side / grid.size) + 1;
  std::vector<Index> cell;
  cell.reserve(points.size());
  for (const auto& point : points) cell.push_back(grid.cell(point));
  grid.landmarks = graph::grouped(cell, grid.across * grid.across);
  return grid;
}

// Calls use(landmark) for every landmark that may be within range.
template <class Use>
void for_each_near(const Grid& grid, const SE2& pose, double range, const Use& use) {
  for (Index row = grid.along(pose.y - range); row <= grid.along(pose.y + range); ++row) {
    const Index from = row * grid.across + grid.along(pose.x - range);
    const Index to = row * grid.across + grid.along(pose.x + range);
    for (Index cell = from; cell <= to; ++cell) {
      for (const Index l : grid.landmarks[cell]) use(l);
    }
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
  const Grid grid = sorted_by_cell(graph.landmarks, side, world.optics.range);
  for (const SE2& pose : graph.poses) {
    const SE2 robot = inverse(pose);
    for_each_near(grid, pose, world.optics.range, [&](Index l) {
      Eigen::Vector3d point(0, 0, 0);
      point.head<2>() = act(robot, graph.landmarks[l].head<2>());
      if (!sees(world.optics, world.sensor, point)) return;
      if (chance(random, world.detection)) graph.seen.items.push_back(l);
    });
    graph.seen.close();
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
  return with_outliers(std::move(graph), world.outliers);
}

}  // namespace sg::world
