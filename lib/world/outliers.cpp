#include "lib/world/outliers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "lib/text/error.h"

namespace sg::world {
namespace {

constexpr int tries = 1000;  // at one that is wrong enough

Index false_count(std::size_t true_count, double share) {
  const double count = std::round(static_cast<double>(true_count) * share / (1 - share));
  if (count + static_cast<double>(true_count) > std::numeric_limits<Index>::max())
    throw text::computation_error("more outliers than a graph can hold");
  return static_cast<Index>(count);
}

// The first that `draw` gives and `is_wrong` takes.
auto drawn(const auto& draw, const auto& is_wrong) {
  for (int k = 0; k < tries; ++k) {
    const auto edge = draw();
    if (is_wrong(edge)) return edge;
  }
  throw text::computation_error("the world is too small for outliers of " +
                                std::to_string(static_cast<int>(least_error)) +
                                " standard deviations");
}

// Squared, in standard deviations.
double size_of(const SE2& error, const PoseNoise& noise) {
  return (error.x * error.x + error.y * error.y) / (noise.translation * noise.translation) +
         std::pow(error.theta / noise.rotation, 2);
}
double size_of(const SE3& error, const PoseNoise& noise) {
  return error.t.squaredNorm() / (noise.translation * noise.translation) +
         4 * error.q.vec().squaredNorm() / (noise.rotation * noise.rotation);
}

}  // namespace

template <class Pose>
PoseGraph<Pose> with_outliers(PoseGraph<Pose> graph, double share) {
  Random random = random_stream(graph.seed, Stream::false_edges);
  const auto loops = static_cast<Index>(graph.loops.size());
  const auto draw = [&] {
    const Index a = below(random, graph.poses), b = below(random, graph.poses);
    return FalseLoop{std::min(a, b), std::max(a, b), below(random, loops)};
  };
  const auto is_wrong = [&](const FalseLoop& loop) {
    if (loop.to - loop.from < 2) return false;
    const Pose error = geometry::between(measured(graph, graph.loops[loop.like]),
                                         measured(graph, {loop.from, loop.to}));
    return size_of(error, graph.noise) >= least_error * least_error;
  };
  for (Index k = false_count(graph.loops.size(), share); k > 0; --k)
    graph.false_loops.push_back(drawn(draw, is_wrong));
  std::ranges::stable_sort(graph.false_loops, {}, &FalseLoop::to);
  return graph;
}
template PoseGraph<SE2> with_outliers(PoseGraph<SE2> graph, double share);
template PoseGraph<SE3> with_outliers(PoseGraph<SE3> graph, double share);

LandmarkGraph with_outliers(LandmarkGraph graph, double share) {
  Random random = random_stream(graph.seed, Stream::false_edges);
  struct Drawn {
    Index pose;
    FalseSight sight;
  };
  const auto sights = static_cast<Index>(graph.seen.items.size());
  const auto draw = [&] {
    const Index k = below(random, sights);
    const auto pose = std::ranges::upper_bound(graph.seen.begin, k) - graph.seen.begin.begin() - 1;
    const Index landmark = below(random, static_cast<Index>(graph.landmarks.size()));
    return Drawn{static_cast<Index>(pose), {landmark, graph.seen.items[k]}};
  };
  const auto is_wrong = [&](const Drawn& d) {
    return separation(graph, d.pose, d.sight.landmark, d.sight.like) >= least_error;
  };
  std::vector<Drawn> all;
  for (Index k = false_count(graph.seen.items.size(), share); k > 0; --k)
    all.push_back(drawn(draw, is_wrong));
  graph.mistaken = graph::counting_sort<FalseSight>(static_cast<Index>(graph.poses.size()),
                                                    [&](const auto& put) {
                                                      for (const Drawn& d : all)
                                                        put(d.pose, d.sight);
                                                    });
  return graph;
}

}  // namespace sg::world
