// sg-solve's options of measurements that may be false: a robust kernel, or graduated non-convexity, and on which edges.
#pragma once

#include <string>
#include <vector>

#include "cmd/common/command.h"
#include "lib/solve/gnc.h"

namespace sg::solving {

struct RobustOptions {
  std::string kernel;  // NAME:W, or empty
  std::string on;      // empty: all but odometry
  bool gnc = false;
  double quantile = 0.99999;
};
void add_robust(CLI::App& app, RobustOptions& options);
// Throws a usage Error for a kernel that there is not, and for options that have no effect.
void check_robust(const CLI::App& app, const RobustOptions& options);

// Needs a checked call.
factor::Loss loss(const RobustOptions& options, const Graph& graph);
solve::GncOptions gnc_options(const RobustOptions& options, const factor::Problem& problem,
                              solve::BatchOptions batch);

}  // namespace sg::solving
