// Odometry step by step: what it measures from each pose to the next.
#pragma once

#include <string>
#include <vector>

#include "lib/graph/lists.h"
#include "lib/graph/replay.h"
#include "lib/prune/motion.h"

namespace sg::prune {

// The odometry edges of every step: step k leads from pose k - 1 to pose k.
graph::Lists<> odometry_steps(const Graph& graph, const graph::PoseIndex& poses);

// The motion of step k, from pose k - 1 to pose k; several edges are fused. Throws an input Error where they are of no
// composable type.
Motion step_motion(const Graph& graph, const graph::PoseIndex& poses,
                   const graph::Lists<>& odometry, Index k);

// Several measurements of a motion from pose `from` on as one.
Motion fuse_from(const Graph& graph, const graph::PoseIndex& poses, Index from,
                 const std::vector<Motion>& motions);

// Throws an input Error unless all edges of step k can be composed, and fused if there are several.
void require_composable(const Graph& graph, const graph::Lists<>& odometry, Index k);
// The same where edges of e's type cannot be fused; which: those that are meant, for the message.
void require_fusible(const Graph& graph, Index e, const std::string& which);
// What there is for a factor that cannot be composed, for the end of a message.
std::string other_way(const Graph& graph, Index e);

}  // namespace sg::prune
