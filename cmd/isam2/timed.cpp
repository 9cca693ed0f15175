#include "cmd/isam2/timed.h"

#include <ctime>

#include "lib/factor/gauge.h"
#include "lib/factor/initialize.h"

namespace sg::isam2 {

double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

bool hold_at_first(factor::Problem& problem) {
  if (problem.held >= 0 || factor::holds_first_pose(problem, factor::start_values(problem)))
    return false;
  factor::hold_first_pose(problem);
  return true;
}

}  // namespace sg::isam2
