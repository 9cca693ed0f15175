// Keyframing (Frey, Steiner, How, section III-B): a subset of the poses stays.
//
// What a dropped pose leaves behind:
//   odometry      between two keyframes in a row is composed into one edge, covariance to first
//                 order. Several odometry edges of one step count as independent measurements and
//                 are fused. What leads on from a segment's last keyframe goes.
//   loop closures move to the nearest keyframe of the same segment (the earlier of two at one
//                 distance, counted in poses), by way of the odometry in between, or go. One whose
//                 ends fall together goes.
//   all other edges go: observations, priors, and whatever else the pose took part in.
// Where revisits are merged, a keyframe that a closure ties to an earlier one near by gives way to it: it is dropped, and
// what is measured from it is measured from its host, composed with the closure. The graph then grows with the space
// that is explored and not with time: the reduced pose graph of Johannsson, Kaess, Fallon, Leonard, Temporally scalable
// visual SLAM using a reduced pose graph (2013).
// Composition is exact to first order edge by edge. Edges that were independent become correlated
// where they share odometry (two moved loop closures, say) or a closure; g2o's format cannot tell.
#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "lib/graph/lists.h"
#include "lib/graph/replay.h"
#include "lib/prune/candidates.h"
#include "lib/prune/steps.h"

namespace sg::prune {

// Where keyframes stand; the first pose of a segment always is one. A fixed pose is one, too,
// whatever the rule: it holds the gauge and costs nothing to eliminate.
struct KeyframeRule {
  Index rate = 0;       // every rate-th pose of a segment; 0: by distance and angle
  double distance = 0;  // travelled since the last keyframe, as odometry measures it; 0: no matter
  double angle = 0;     // turned since, in radians, summed step by step; 0: no matter
};

// What is near enough to be the same place.
struct Revisit {
  double distance;  // metres
  double angle;     // radians
};

struct KeyframingOptions {
  bool move_loops = true;          // else they go
  std::optional<Revisit> revisit;  // merge such keyframes into earlier ones
  bool fuse = false;  // edges that come to join the same pair become one, their information added
};

// Throws an input Error where distance or angle cannot be measured, for a step whose edges are of
// no composable type.
std::vector<bool> choose_keyframes(const Graph& graph, const graph::PoseIndex& poses,
                                   const graph::Lists<>& odometry, const KeyframeRule& rule);

// The graph between its keyframes. Holds references to the graph, its poses and its odometry.
struct Keyframing {
  const Graph& graph;
  const graph::PoseIndex& poses;
  const graph::Lists<>& odometry;
  std::vector<Index> nearest;  // nearest keyframe of every pose, by pose index
  std::vector<Index>
      host;  // by pose index: the earlier keyframe that one is merged into, else itself
  std::vector<bool> rewritten;  // m: edges with a new line
  std::vector<bool> composed;  // m: those of them that stand for all odometry between two keyframes
  std::vector<bool> late;      // m: edges whose new line would stand before the VERTEX of its ends
  Removal removal;
  Index dropped_priors = 0;                           // unary edges of dropped poses
  Index collapsed_loops = 0;                          // loop closures whose ends fell together
  Index merged = 0;                                   // keyframes with a host
  std::unordered_map<Index, Motion> milestones = {};  // nearest keyframe -> pose, on long ways
  std::unordered_map<Index, Motion> from_host = {};   // host -> keyframe
  std::unordered_map<Index, std::vector<Index>> fused =
      {};  // edge -> all that it stands for, itself included
};

// Decides the fate of every edge and checks that what has to be composed can be: throws an input
// Error that names the first edge of which this does not hold. O(edges).
Keyframing keyframing(const Graph& graph, const graph::PoseIndex& poses,
                      const graph::Lists<>& odometry, const std::vector<bool>& keyframe,
                      const KeyframingOptions& options);
Keyframing keyframing(const Graph&&, const graph::PoseIndex&, const graph::Lists<>&,
                      const std::vector<bool>&, const KeyframingOptions&) = delete;
Keyframing keyframing(const Graph&, const graph::PoseIndex&&, const graph::Lists<>&,
                      const std::vector<bool>&, const KeyframingOptions&) = delete;
Keyframing keyframing(const Graph&, const graph::PoseIndex&, const graph::Lists<>&&,
                      const std::vector<bool>&, const KeyframingOptions&) = delete;

// The motion from pose `from` to another pose `to` of one segment, by pose index, composed from
// odometry.
Motion travelled(const Keyframing& keyframing, Index from, Index to);

// The new line of an edge that is rewritten. Amortized O(1) steps of odometry for composed
// odometry, O(distance to the keyframe) and at most `milestone_spacing` for a loop closure.
constexpr Index milestone_spacing = 64;
std::string rewritten_line(const Keyframing& keyframing, Index e);

}  // namespace sg::prune
