// Steps of a replay through iSAM2, timed.
#pragma once

#include "lib/solve/isam2_replay.h"

namespace sg::isam2 {

// Processor time: what other programs on the machine do does not count, and a step of a millisecond
// that is interrupted for ten stays a step of a millisecond.
double processor_seconds();

struct TimedStep {
  solve::Isam2Report report;
  double seconds;
};
TimedStep timed_step(solve::Isam2Replay& replay, Index k);

// A replay needs its gauge from the first step on; what holds the whole graph may come later. Holds the first pose where
// nothing else does so in the first step; true where it had to.
bool hold_at_first(factor::Problem& problem);

}  // namespace sg::isam2
