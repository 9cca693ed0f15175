#include "lib/world/sphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/world/outliers.h"

namespace sg::world {
namespace {

constexpr double pi = std::numbers::pi;

// x along the way, z away from the centre.
SE3 on_sphere(double latitude, double longitude, double radius) {
  const double c = std::cos(latitude), s = std::sin(latitude);
  const double cl = std::cos(longitude), sl = std::sin(longitude);
  Eigen::Matrix3d R;
  R << -sl, -s * cl, c * cl, cl, -s * sl, c * sl, 0, c, s;
  return {Eigen::Quaterniond(R), radius * R.col(2)};
}

}  // namespace

PoseGraph<SE3> sphere(const Sphere& world) {
  const Index n = world.poses;
  const auto root = static_cast<Index>(std::lround(std::sqrt(static_cast<double>(n))));
  const Index turn = world.turn > 0 ? world.turn : std::max<Index>(root, 2);
  const double radius = world.radius > 0 ? world.radius : turn / (2 * pi);
  Random random = random_stream(world.seed, Stream::structure);
  std::vector<Loop> loops;
  for (Index k = turn; k < n; ++k) {
    if (chance(random, world.loop_chance)) loops.push_back({k - turn, k});
  }
  const auto truth = [n, turn, radius](Index k) {
    const double latitude = pi * ((k + 0.5) / n - 0.5);
    return on_sphere(latitude, 2 * pi * (k % turn) / turn, radius);
  };
  return with_outliers<SE3>({.poses = n,
                             .truth = truth,
                             .loops = std::move(loops),
                             .noise = world.noise,
                             .guess = world.guess,
                             .seed = world.seed},
                            world.outliers);
}

}  // namespace sg::world
