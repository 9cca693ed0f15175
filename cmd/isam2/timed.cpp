#include "cmd/isam2/timed.h"

#include "lib/factor/gauge.h"
#include "lib/factor/initialize.h"

namespace sg::isam2 {

bool hold_at_first(factor::Problem& problem) {
  if (problem.held >= 0 || factor::holds_first_pose(problem, factor::start_values(problem)))
    return false;
  factor::hold_first_pose(problem);
  return true;
}

}  // namespace sg::isam2
