#include "lib/world/sine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "lib/text/error.h"
#include "lib/world/outliers.h"

namespace sg::world {
namespace {

// y = A sin(w x), by its slope.
struct Path {
  double amplitude;
  double w;
  double slope(double x) const { return amplitude * w * std::cos(w * x); }
};

// dx/ds along the path, s its length.
double advance(const Path& path, double x) {
  const double slope = path.slope(x);
  return 1 / std::sqrt(1 + slope * slope);
}

// Where x is after `step` metres along the path, by Runge-Kutta of fourth order in substeps that are
// short against the wavelength.
double walk(const Path& path, double x, double step) {
  const int substeps = 4 + static_cast<int>(std::min(1000.0, 10 * step * std::abs(path.w)));
  const double h = step / substeps;
  for (int i = 0; i < substeps; ++i) {
    const double k1 = advance(path, x), k2 = advance(path, x + h / 2 * k1);
    const double k3 = advance(path, x + h / 2 * k2), k4 = advance(path, x + h * k3);
    x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return x;
}

std::vector<SE2> path_poses(const Sine& world) {
  const Path path{world.amplitude, 2 * std::numbers::pi / world.wavelength};
  std::vector<SE2> poses;
  poses.reserve(world.poses);
  double x = 0;
  for (Index k = 0; k < world.poses; ++k) {
    poses.push_back(
        rounded(SE2{x, path.amplitude * std::sin(path.w * x), std::atan(path.slope(x))}));
    x = rounded(walk(path, x, world.step));
  }
  return poses;
}

Index landmark_count(const Sine& world, double area) {
  if (world.landmarks > 0) return world.landmarks;
  const double count = std::round(world.density * area);
  if (!(count <= std::numeric_limits<Index>::max()))
    throw text::computation_error("the density asks for more landmarks than a graph can hold");
  return static_cast<Index>(count);
}

// The profile at x of a path that ends at `end`; constant beyond.
double profile_at(const std::vector<double>& profile, double x, double end) {
  if (profile.empty()) return 1;
  const auto last = static_cast<double>(profile.size() - 1);
  const double at = end > 0 ? std::clamp(x / end * last, 0.0, last) : 0;
  const auto k = std::min(static_cast<std::size_t>(at), profile.size() - 1);
  const double next = profile[std::min(k + 1, profile.size() - 1)];
  return profile[k] + (at - static_cast<double>(k)) * (next - profile[k]);
}

// Of the profile, from `from` to `to`.
double profile_mean(const std::vector<double>& profile, double from, double to, double end) {
  if (profile.empty()) return 1;
  constexpr int samples = 10000;
  double sum = 0;
  for (int i = 0; i < samples; ++i)
    sum += profile_at(profile, from + (i + 0.5) * (to - from) / samples, end);
  return sum / samples;
}

// Uniform in the slab but for the profile, by ascending x.
std::vector<Eigen::Vector3d> scattered_landmarks(const Sine& world, double end) {
  const double from = -world.optics.range, to = end + world.optics.range;
  Random random = random_stream(world.seed, Stream::structure);
  const double area = (to - from) * 2 * world.width;
  const double most = world.profile.empty() ? 1 : *std::ranges::max_element(world.profile);
  std::vector<Eigen::Vector3d> landmarks(
      landmark_count(world, area * profile_mean(world.profile, from, to, end)));
  for (auto& l : landmarks) {
    do {
      l.x() = rounded(uniform(random, from, to));
    } while (!world.profile.empty() &&
             uniform(random, 0, most) >= profile_at(world.profile, l.x(), end));
    l.y() = rounded(uniform(random, -world.width, world.width));
    l.z() = rounded(uniform(random, -world.height, world.height));
  }
  std::ranges::sort(landmarks, {}, [](const auto& l) { return std::tuple(l.x(), l.y()); });
  return landmarks;
}

void look(const Sine& world, LandmarkGraph& graph) {
  const double range = world.optics.range;
  Index first = 0;  // landmark that may be in range; the path never turns back
  for (const SE2& pose : graph.poses) {
    const auto count = static_cast<Index>(graph.landmarks.size());
    while (first < count && graph.landmarks[first].x() < pose.x - range) ++first;
    for (Index l = first; l < count && graph.landmarks[l].x() <= pose.x + range; ++l) {
      const Eigen::Vector3d& landmark = graph.landmarks[l];
      Eigen::Vector3d point;
      point << act(inverse(pose), landmark.head<2>()), landmark.z();
      if (sees(world.optics, world.sensor, point)) graph.seen.items.push_back(l);
    }
    graph.seen.close();
  }
}

}  // namespace

LandmarkGraph sine(const Sine& world) {
  LandmarkGraph graph = begin_landmark_graph(world);
  graph.poses = path_poses(world);
  graph.landmarks = scattered_landmarks(world, graph.poses.back().x);
  look(world, graph);
  keep_triangulated(graph, world.landmark);
  return with_outliers(std::move(graph), world.outliers);
}

}  // namespace sg::world
