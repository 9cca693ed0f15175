// How sure a graph is of its vertices at its estimate: covariances of their steps (lib/factor/space.h), from the inverse
// of the information A' A, its gauge fixed (problem.h). What stands still, a constant or what the gauge holds, has none:
// zero.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "lib/factor/problem.h"
#include "lib/solve/eliminate.h"
#include "lib/text/error.h"

namespace sg::score {

// The problem's information at `values`, eliminated in this order, which matters to speed alone; nothing where it is
// singular: some variable is not determined.
std::optional<solve::Elimination> eliminated(const factor::Problem& problem,
                                             const factor::Values& values,
                                             const graph::Order& order);
// The Error that says why there is nothing.
text::Error singular_error(const factor::Problem& problem, const factor::Values& values);

// Of every vertex, dim x dim.
std::vector<Eigen::MatrixXd> vertex_covariances(const factor::Problem& problem,
                                                solve::Elimination& elimination);

// Of two vertices together, the scalars of a before those of b.
Eigen::MatrixXd joint_covariance(const factor::Problem& problem, solve::Elimination& elimination,
                                 Index a, Index b);

// Of a covariance of a vertex's step the part that moves it, d x d with d = 2 or 3, in the world's axes. values: the
// vertex's estimate.
Eigen::MatrixXd position_covariance(graph::Space space, const double* values,
                                    const Eigen::MatrixXd& covariance);

// The ellipse, or ellipsoid, of one standard deviation of a position.
struct Ellipse {
  std::vector<double> axes;  // half of each, the longest first
  double angle;  // of the longest, in the plane of the first two coordinates: (-pi/2, pi/2]
};
Ellipse ellipse(const Eigen::MatrixXd& position_covariance);

}  // namespace sg::score
