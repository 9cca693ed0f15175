#include "lib/prune/decimate.h"

#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_int_distribution.hpp>
#include <limits>

namespace sg::prune {
namespace {

struct Sighting {
  Index pose;      // index of the pose that observes
  Index landmark;  // vertex that is observed
};

Sighting sighting(const Graph& graph, const graph::PoseIndex& poses, Index e) {
  Sighting result{-1, -1};
  Index earliest = -1;
  for (Index v : graph.edge(e)) {
    if (graph.role(v) == graph::Role::landmark && result.landmark < 0) result.landmark = v;
    if (poses.index[v] < 0) continue;
    result.pose = std::max(result.pose, poses.index[v]);
    if (earliest < 0 || poses.index[v] < poses.index[earliest]) earliest = v;
  }
  if (result.landmark < 0) result.landmark = earliest;
  return result;
}

std::vector<Index> first_offsets(const Graph& graph, const graph::PoseIndex& poses,
                                 const std::vector<Index>& candidates, Index rate) {
  std::vector<Index> offset(graph.vertices(), 0);
  for (std::size_t v = 0; v < offset.size(); ++v) {
    if (graph.role(v) == graph::Role::landmark) offset[v] = std::numeric_limits<Index>::max();
  }
  for (Index e : candidates) {
    const auto [pose, landmark] = sighting(graph, poses, e);
    offset[landmark] = std::min(offset[landmark], pose);  // 0 of a pose
  }
  for (Index& k : offset) k %= rate;
  return offset;
}

// Drawn for every vertex by ascending id, so that they depend on nothing but the ids and the seed.
std::vector<Index> random_offsets(const Graph& graph, Index rate, std::uint64_t seed) {
  boost::random::mt19937_64 bits(seed);
  boost::random::uniform_int_distribution<Index> draw(0, rate - 1);
  std::vector<Index> offset(graph.vertices());
  for (Index& k : offset) k = draw(bits);
  return offset;
}

}  // namespace

std::vector<bool> decimate(const Graph& graph, const graph::PoseIndex& poses,
                           const std::vector<Index>& candidates, Index rate, DecimationOffset kind,
                           std::uint64_t seed) {
  const std::vector<Index> offset =
      kind == DecimationOffset::first    ? first_offsets(graph, poses, candidates, rate)
      : kind == DecimationOffset::random ? random_offsets(graph, rate, seed)
                                         : std::vector<Index>(graph.vertices(), 0);
  std::vector<bool> kept(candidates.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const auto [pose, landmark] = sighting(graph, poses, candidates[i]);
    kept[i] = pose % rate == offset[landmark];
  }
  return kept;
}

}  // namespace sg::prune
