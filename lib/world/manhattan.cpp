#include "lib/world/manhattan.h"

#include <algorithm>
#include <memory>

#include "lib/world/outliers.h"

namespace sg::world {
namespace {

// The last pose at every place of a square, -1 where nobody was.
struct Visits {
  Index side;
  std::vector<Index> last;
  explicit Visits(Index side_)
      : side(side_), last(static_cast<std::size_t>(side_ + 1) * (side_ + 1), -1) {}
  Index& at(Index x, Index y) { return last[static_cast<std::size_t>(y) * (side + 1) + x]; }
};

void add_loops(const Manhattan& world, Index k, const StreetPose& at, Visits& visits,
               Random& random, std::vector<Loop>& loops) {
  const Index left = std::max(at.x - world.reach, 0),
              right = std::min(at.x + world.reach, visits.side);
  const Index low = std::max(at.y - world.reach, 0),
              high = std::min(at.y + world.reach, visits.side);
  for (Index y = low; y <= high; ++y) {
    for (Index x = left; x <= right; ++x) {
      const Index seen = visits.at(x, y);
      if (seen < 0 || k - seen <= world.gap) continue;
      if (chance(random, world.loop_chance)) loops.push_back({seen, k});
    }
  }
}

}  // namespace

PoseGraph<SE2> manhattan(const Manhattan& world) {
  Random random = random_stream(world.seed, Stream::structure);
  const auto walk = std::make_shared<const std::vector<StreetPose>>(
      street_walk(world.streets, world.poses, random));
  Visits visits(side_of(world.streets, world.poses));
  std::vector<Loop> loops;
  for (Index k = 0; k < world.poses; ++k) {
    const StreetPose& at = (*walk)[k];
    add_loops(world, k, at, visits, random, loops);
    visits.at(at.x, at.y) = k;
  }
  return with_outliers<SE2>({.poses = world.poses,
                             .truth = [walk](Index k) { return pose((*walk)[k]); },
                             .loops = std::move(loops),
                             .noise = world.noise,
                             .guess = world.guess,
                             .seed = world.seed},
                            world.outliers);
}

}  // namespace sg::world
