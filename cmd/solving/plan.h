// How sg-solve optimizes where a call says nothing else.
#pragma once

#include <string>

#include "cmd/common/method.h"
#include "lib/solve/linear_solver.h"

namespace sg::solving {

constexpr int most_iterations = 1000;  // which have to converge

struct Plan {
  const cmd::MethodOptions& method;
  const std::string& backend;
  int threads;
};
// What eliminates a problem's systems, in the order that the method gives its graph.
solve::LinearSolver planned(const Plan& plan, const factor::Problem& problem,
                            const factor::LinearSystem& system);

// Which vertices' lines an optimization rewrites: all but the constants.
std::vector<bool> moved(const factor::Problem& problem);

}  // namespace sg::solving
