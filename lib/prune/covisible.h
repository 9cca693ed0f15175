// Keyframes by covisibility, as visual SLAM systems cull them: a keyframe goes if most of its landmarks are seen from
// enough others (Mur-Artal, Montiel, Tardos, ORB-SLAM, 2015, section VI-E: 90 % from three others).
#pragma once

#include <vector>

#include "lib/graph/lists.h"
#include "lib/graph/replay.h"

namespace sg::prune {

struct CovisibleRule {
  double part;   // of its landmarks, in (0, 1]
  Index others;  // keyframes that see each of them
};

// In the order of time: every pose enters as a keyframe, and those that share a landmark with it, earlier ones first, are
// judged anew. Poses that see no landmark, first poses of segments (no odometry leads there) and fixed ones stay.
std::vector<bool> covisible_keyframes(const Graph& graph, const graph::PoseIndex& poses,
                                      const graph::Lists<>& odometry, const CovisibleRule& rule);

}  // namespace sg::prune
