// sg-solve --calibrate: how long kinds of work take on this machine (lib/solve/forecast.h).
#pragma once

#include <span>
#include <vector>

#include "lib/solve/forecast.h"

namespace sg::solving {

// Eliminations of generated graphs, small and large, narrow and wide, in several orders, each timed on one thread.
std::vector<solve::Sample> timed_samples();

// How well times explain samples: R^2 of log seconds, and the largest factor that one is off by.
struct Fit {
  double r2;
  double worst;
};
Fit fit_of(std::span<const solve::Sample> samples, const solve::Times& times);

}  // namespace sg::solving
