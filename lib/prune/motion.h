// The measured motion between two poses as an edge line gives it, for the types that can be
// composed: EDGE_SE2, EDGE_SE3:QUAT and EDGE_SE3:EXPMAP.
//
// All give z, the second pose in the frame of the first. They differ in where their error stands:
//   EDGE_SE2, EDGE_SE3:QUAT   in z's end frame (lib/geometry);
//   EDGE_SE3:EXPMAP           in the world frame: the file's z is read as C = z^-1, and the error
//   is
//                             log(X2 C X1^-1) with X camera-to-world. Hence two errors in a row add
//                             up as they are, without any adjoint, and an inverse changes the sign.
// Source of the conventions: g2o's types (sg-graph.5). First-order propagation: Smith, Self,
// Cheeseman (1990).
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "lib/geometry/se2.h"
#include "lib/geometry/se3.h"
#include "lib/graph/graph.h"

namespace sg::prune {

struct ExpmapMotion {
  SE3 mean;              // second pose in the frame of the first
  Matrix6d information;  // of the world-frame error (rotation, translation), as the file has it
};

using Motion = std::variant<geometry::UncertainSE2, geometry::UncertainSE3, ExpmapMotion>;

// Whether `motion` can read edges of this type.
bool is_motion(graph::EdgeTag type);
// The measurement of edge e, if it is of such a type. Throws an input Error where a number is not
// finite or the information not positive semidefinite.
std::optional<Motion> motion(const Graph& graph, Index e);

// Of two motions of one type, the first then the second; first-order propagation of covariance.
Motion compose(const Motion& first, const Motion& second);
Motion inverse(const Motion& motion);

// Several independent measurements of one motion as one: their weighted least-squares mean and its
// information. All of one type. An EDGE_SE3:EXPMAP weighs in the world frame, hence needs the first
// pose's estimate.
Motion fuse(const std::vector<Motion>& motions, const SE3& first_pose);

// In space, those of the plane in z = 0.
SE3 mean(const Motion& motion);

// How far a motion goes (in the file's unit of length) and turns (radians, 0 .. pi).
double distance(const Motion& motion);
double angle(const Motion& motion);

// "TAG first second measurement information", without a line end; numbers round-trip.
std::string edge_text(const Motion& motion, Id first, Id second);

}  // namespace sg::prune
