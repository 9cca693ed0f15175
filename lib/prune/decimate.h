// Decimation (Frey, Steiner, How, algorithm 1): of every landmark j, the observations from poses i
// with i mod r = k_j stay. Landmarks with the same offset k_j share poses, landmarks of different
// offsets do not, which parts the graph into r loosely joined pieces.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/graph/graph.h"
#include "lib/graph/replay.h"

namespace sg::prune {

enum class DecimationOffset : std::uint8_t {
  first,  // the pose index of the landmark's first observation, mod r: that one stays; 0 of a pose
  aligned,  // 0 for all
  random,   // drawn per landmark
};

// Which of the candidates stay, side by side with them. The observing pose of an edge is its last;
// its landmark is the first that it names. Of a loop closure, the earlier pose stands for the landmark.
// Most places are closed upon once or twice: to keep the first closure of each would keep nearly all.
// Hence closures stay by the later pose's index alone, unless offsets are drawn.
// rate >= 1; `seed` matters to random offsets alone. O(candidates + vertices).
std::vector<bool> decimate(const Graph& graph, const graph::PoseIndex& poses,
                           const std::vector<Index>& candidates, Index rate,
                           DecimationOffset offset, std::uint64_t seed);

}  // namespace sg::prune
