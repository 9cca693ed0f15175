#include "lib/world/torus.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/world/outliers.h"

namespace sg::world {
namespace {

constexpr double pi = std::numbers::pi;

// `around` the torus, `along` the tube's own circle. x along the way, z away from the tube's centre.
SE3 on_torus(double around, double along, double tube, double ratio) {
  const double ca = std::cos(around), sa = std::sin(around);
  const double ct = std::cos(along), st = std::sin(along);
  Eigen::Matrix3d R;
  R.col(0) << -st * ca, -st * sa, ct;
  R.col(2) << ct * ca, ct * sa, st;
  R.col(1) = R.col(2).cross(R.col(0));
  return {Eigen::Quaterniond(R), tube * (ratio * Eigen::Vector3d(ca, sa, 0) + R.col(2))};
}

std::vector<Loop> found_loops(const Torus& world, Index turn) {
  Random random = random_stream(world.seed, Stream::structure);
  const Index n = world.poses;
  std::vector<Loop> loops;
  for (Index k = 0; k < n; ++k) {
    const Index before = k - turn, after = k + turn - n;  // the first turn follows the last
    if (before >= 0 && chance(random, world.loop_chance)) loops.push_back({before, k});
    if (after >= 0 && after < k - 1 && after != before && chance(random, world.loop_chance)) {
      loops.push_back({after, k});
    }
  }
  return loops;
}

}  // namespace

PoseGraph<SE3> torus(const Torus& world) {
  const Index n = world.poses;
  const auto root = static_cast<Index>(std::lround(std::sqrt(n / 2.0)));
  const Index turn = world.turn > 0 ? world.turn : std::max<Index>(root, 2);
  const double tube = world.tube > 0 ? world.tube : turn / (2 * pi);
  const auto truth = [n, turn, tube, ratio = world.ratio](Index k) {
    return on_torus(2 * pi * k / n, 2 * pi * (k % turn) / turn, tube, ratio);
  };
  return with_outliers<SE3>({.poses = n,
                             .truth = truth,
                             .loops = found_loops(world, turn),
                             .noise = world.noise,
                             .guess = world.guess,
                             .seed = world.seed},
                            world.outliers);
}

}  // namespace sg::world
