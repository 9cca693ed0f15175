#include "lib/score/dopt.h"

#include <limits>

#include "lib/solve/eliminate.h"

namespace sg {

double log_det_information(const Problem& problem, const Values& values, const Order& order) {
  LinearSystem system = make_linear_system(problem);
  linearize(problem, values, {}, system);
  Elimination elimination = plan_elimination(system, order);
  if (!eliminate(elimination, system).empty()) return -std::numeric_limits<double>::infinity();
  return log_determinant(elimination);
}

}  // namespace sg
