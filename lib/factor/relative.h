// From one estimate to another, as a step; and an estimate as a pose sees it. With their slopes.
#pragma once

#include <Eigen/Core>
#include <array>

#include "lib/factor/model.h"

namespace sg::factor {

using Slope =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, max_step, max_step>;
using Step = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, max_step, 1>;
constexpr int max_size = 10;  // numbers of an estimate

// The step that retract takes from x0 to x, and its slope in a step of x.
struct Difference {
  Step step;
  Slope slope;
};
Difference difference(graph::Space space, const double* x0, const double* x);

// Whether a pose of the one space sees what is of the other as more than pixels: z = pose^-1 x.
bool sees(graph::Space pose, graph::Space space);
struct Seen {
  std::array<double, max_size> z;  // an estimate of x's space
  Slope of_pose, of_x;             // the slopes of a step of z
};
Seen seen_from(graph::Space from, const double* pose, graph::Space space, const double* x);
// Back: the x that the pose sees at z. Both of spaces that `sees` allows.
void place_seen(graph::Space from, const double* pose, graph::Space space, const double* z,
                double* x);

}  // namespace sg::factor
