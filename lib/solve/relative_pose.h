// What edges between two poses measure, as numbers that can be composed, and an edge's numbers and ends replaced: how a
// graph is rewritten while it is solved (isam2_keyframes.h). Of EDGE_SE2, EDGE_SE3:QUAT and EDGE_SE3:EXPMAP; sg-kf composes
// the same lines as text, and says where their errors stand (lib/prune/motion.h).
#pragma once

#include <memory>
#include <variant>

#include "lib/factor/problem.h"
#include "lib/geometry/se2.h"
#include "lib/geometry/se3.h"

namespace sg::solve {

struct UncertainExpmap {
  SE3 mean;
  Matrix6d information;  // of the world-frame error (rotation, translation)
};

// The second pose in the frame of the first.
using RelativePose = std::variant<geometry::UncertainSE2, geometry::UncertainSE3, UncertainExpmap>;

bool is_relative_pose(const Graph& graph, Index e);
// Of such an edge, from its first end to its second.
RelativePose relative_pose(const factor::Problem& problem, Index e);

// Of one kind; covariances to first order.
RelativePose compose(const RelativePose& first, const RelativePose& second);
RelativePose inverse(const RelativePose& pose);

// The trace of the position's covariance; infinite where the information is singular.
double variance(const RelativePose& pose);

// The estimate of the second end by the first's, where it is free of noise.
void place(const RelativePose& pose, const double* first, double* second);

// Moves the estimate x of a pose a share of the way (0 to 1) to another estimate of it.
void blend(graph::Space space, const double* other, double share, double* x);

// A graph and its problem that may be written to: copies, which stay where they are.
struct Rewritable {
  Graph graph;
  factor::Problem problem;
};
std::unique_ptr<Rewritable> rewritable(const factor::Problem& problem);

// Edge e joins these poses and measures this, from now on. All of the kind that it joined before; variables, all four.
void rewrite(Rewritable& own, Index e, Index first, Index second, const RelativePose& pose);

}  // namespace sg::solve
