// The gauge: what moves the whole, and whether the measurements notice.
//
// Measurements between vertices notice neither where the whole stands nor how it is turned. What else there is may: a
// unary edge, an edge to a constant, and one between landmarks alone, whose measurement is in the world's frame. They
// hold the gauge if they notice every rigid motion, which is a question of rank, not of tags: three position priors
// hold a map that one of them lets turn, a prior without information holds nothing. Cameras and bearings do not notice
// how large the whole is, either; then its scale is free.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "lib/factor/linearize.h"

namespace sg::factor {

// The steps of all variables, by scalar, that the six rigid motions of the whole make, about the centre of its vertices
// and in units of its radius; those of the plane are three, and zeros.
Eigen::MatrixXd rigid_motions(const Problem& problem, const Values& values);

// Whether an edge can notice a motion of the whole.
bool is_anchor(const Problem& problem, Index e);

// Whether those of `edges` that can notice every rigid motion of `vertices` at these estimates. The problem holds none.
bool holds_gauge(const Problem& problem, const Values& values, std::span<const Index> vertices,
                 std::span<const Index> edges);

// The same, of all edges and vertices.
bool holds_gauge(const Problem& problem, const Values& values);

// Whether the first pose is a constant, or its own edges hold the gauge.
bool holds_first_pose(const Problem& problem, const Values& values);

// Holds the first pose, of a graph without one the first vertex: makes the columns of its motions zero, and a last row
// for them. A camera's focal length is not held with it.
void hold_first_pose(Problem& problem);

// Vertices that stay while others are placed by some of the edges: constants, what the gauge holds, and the first pose
// (else vertex) of every part that these edges join to none of them and that no unary one of them holds.
std::vector<bool> anchors(const Problem& problem, const std::vector<bool>& edge_left_out);

// A step, by scalar, that changes the scale of the whole without any measurement's noticing; empty if there is none.
std::vector<double> free_scaling(const Problem& problem, const Values& values,
                                 const LinearSystem& system);

}  // namespace sg::factor
