// How well a graph knows where its poses are: standard deviations of positions at its estimate.
#pragma once

#include <vector>

#include "lib/score/covariance.h"

namespace sg::score {

// The root of the trace of its position's covariance, in the file's unit of length; 0 of a pose that stands still.
struct PoseSigma {
  Index vertex;
  double sigma;
};
// Of all poses, by ascending id.
std::vector<PoseSigma> pose_sigmas(const factor::Problem& problem, const factor::Values& values,
                                   solve::Elimination& elimination);

}  // namespace sg::score
