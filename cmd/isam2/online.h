// What a robot would have seen of its estimate on the way: errors against the truth, and what steps took.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cmd/common/command.h"
#include "lib/score/trajectory.h"
#include "lib/solve/isam2_window.h"

namespace sg::isam2 {

// Metres from where the truth has the newest pose, of a step's last, when the first pose stands where the truth has it.
// Nothing where the truth has no such pose.
std::optional<double> online_error(const solve::Isam2Replay& replay, const score::Trajectory& truth,
                                   Index step);

// Standard deviation of the newest pose's position: the root of the trace of its covariance, in metres. 0 of a constant.
double online_sigma(solve::Isam2Replay& replay, Index step);

// By elimination complexity and seconds of the steps so far: the least-squares line, recent steps weighing more.
struct Calibration {
  double weight = 0, x = 0, y = 0, xx = 0, xy = 0;
};
void add(Calibration& calibration, double ec, double seconds);
// The EC that takes so many seconds; at least 1.
double ec_of(const Calibration& calibration, double seconds);

struct Summary {
  std::vector<double> seconds, ec, error;  // by step
  Index violations = 0;                    // steps that ended above the budget
};
// Lines for standard error: p50, p95, p99 and the largest of the steps' seconds and EC, mean and largest error; then what
// was dropped, which share of the time went into choosing, and what broke the budget, if anything.
std::vector<std::string> lines(const Summary& summary, const solve::Isam2Window& window,
                               bool budget);

}  // namespace sg::isam2
