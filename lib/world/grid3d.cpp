#include "lib/world/grid3d.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "lib/world/outliers.h"

namespace sg::world {
namespace {

struct GridPoint {
  Index x;
  Index y;
  Index z;
};

constexpr std::array<GridPoint, 6> directions{
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};

GridPoint moved(const GridPoint& at, const GridPoint& by) {
  return {at.x + by.x, at.y + by.y, at.z + by.z};
}

bool inside(const GridPoint& at, Index side) {
  const auto [low, high] = std::minmax({at.x, at.y, at.z});
  return low >= 0 && high < side;
}

// Looking along a direction of the grid: the rotation by which x comes to lie there.
Eigen::Quaterniond looking(int direction) {
  const double h = std::sqrt(0.5);
  switch (direction) {
    case 0:
      return {1, 0, 0, 0};
    case 1:
      return {h, 0, 0, h};
    case 2:
      return {h, 0, -h, 0};
    case 3:
      return {0, 0, 0, 1};
    case 4:
      return {h, 0, 0, -h};
    default:
      return {h, 0, h, 0};
  }
}

// A pose looks where it came from its predecessor.
SE3 pose_at(const GridPoint& at, const GridPoint& before) {
  const GridPoint step{at.x - before.x, at.y - before.y, at.z - before.z};
  int direction = 0;
  while (direction < 5 && (directions[direction].x != step.x || directions[direction].y != step.y ||
                           directions[direction].z != step.z)) {
    ++direction;
  }
  const bool start = step.x == 0 && step.y == 0 && step.z == 0;
  return {looking(start ? 0 : direction), Eigen::Vector3d(at.x, at.y, at.z)};
}

// The sweep, forth and back in every line and every layer.
GridPoint swept(Index k, Index side) {
  const Index layer = side * side, z = k / layer, in_layer = k % layer;
  const Index j = z % 2 == 0 ? in_layer : layer - 1 - in_layer, y = j / side;
  return {y % 2 == 0 ? j % side : side - 1 - j % side, y, z};
}
Index sweep_index(const GridPoint& at, Index side) {
  const Index layer = side * side, j = at.y * side + (at.y % 2 == 0 ? at.x : side - 1 - at.x);
  return at.z * layer + (at.z % 2 == 0 ? j : layer - 1 - j);
}

PoseGraph<SE3> swept_graph(const Grid3d& world, Index side, Random& random) {
  PoseGraph<SE3> graph;
  for (Index k = 0; k < world.poses; ++k) {
    for (const GridPoint& direction : directions) {
      const GridPoint at = moved(swept(k, side), direction);
      if (at.z < 0 || !inside({at.x, at.y, 0}, side)) continue;
      const Index other = sweep_index(at, side);
      if (other < k - 1 && chance(random, world.loop_chance)) graph.loops.push_back({other, k});
    }
  }
  graph.truth = [side](Index k) {
    return pose_at(swept(k, side), swept(std::max(k - 1, 0), side));
  };
  return graph;
}

std::vector<GridPoint> random_walk(const Grid3d& world, Index side, Random& random) {
  std::vector<GridPoint> walk{{0, 0, 0}};
  walk.reserve(world.poses);
  while (static_cast<Index>(walk.size()) < world.poses) {
    const GridPoint next = moved(walk.back(), directions[below(random, 6)]);
    if (inside(next, side)) walk.push_back(next);
  }
  return walk;
}

PoseGraph<SE3> walked_graph(const Grid3d& world, Index side, Random& random) {
  const auto walk =
      std::make_shared<const std::vector<GridPoint>>(random_walk(world, side, random));
  const auto place = [side](const GridPoint& at) {
    return (static_cast<std::size_t>(at.z) * side + at.y) * side + at.x;
  };
  std::vector<Index> last(static_cast<std::size_t>(side) * side * side, -1);
  PoseGraph<SE3> graph;
  const auto recognize = [&](const GridPoint& at, Index k) {
    if (!inside(at, side)) return;
    const Index seen = last[place(at)];
    if (seen >= 0 && seen < k - 1 && chance(random, world.loop_chance)) {
      graph.loops.push_back({seen, k});
    }
  };
  for (Index k = 0; k < world.poses; ++k) {
    recognize((*walk)[k], k);
    for (const GridPoint& direction : directions) recognize(moved((*walk)[k], direction), k);
    last[place((*walk)[k])] = k;
  }
  graph.truth = [walk](Index k) { return pose_at((*walk)[k], (*walk)[std::max(k - 1, 0)]); };
  return graph;
}

Index side_of(const Grid3d& world) {
  if (world.side > 0) return world.side;
  const double points = world.walk == GridWalk::sweep ? world.poses : world.poses / 2.0;
  auto side = static_cast<Index>(std::lround(std::cbrt(points)));
  while (static_cast<double>(side) * side * side < points) ++side;
  return std::max<Index>(side, 2);
}

}  // namespace

PoseGraph<SE3> grid3d(const Grid3d& world) {
  const Index side = side_of(world);
  Random random = random_stream(world.seed, Stream::structure);
  PoseGraph<SE3> graph = world.walk == GridWalk::sweep ? swept_graph(world, side, random)
                                                       : walked_graph(world, side, random);
  graph.poses = world.poses;
  graph.noise = world.noise;
  graph.guess = world.guess;
  graph.seed = world.seed;
  return with_outliers(std::move(graph), world.outliers);
}

}  // namespace sg::world
