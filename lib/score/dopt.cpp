#include "lib/score/dopt.h"

#include <limits>

#include "lib/solve/eliminate.h"

namespace sg::score {

double log_det_information(const factor::Problem& problem, const factor::Values& values,
                           const graph::Order& order) {
  factor::LinearSystem system = factor::make_linear_system(problem);
  factor::linearize(problem, values, {}, system);
  solve::Elimination elimination = solve::plan_elimination(system, order);
  if (!solve::eliminate(elimination, system).empty())
    return -std::numeric_limits<double>::infinity();
  return solve::log_determinant(elimination);
}

}  // namespace sg::score
