#include "lib/score/dopt.h"

#include <cmath>
#include <limits>

#include "lib/solve/cholmod.h"
#include "lib/text/error.h"

namespace sg {
namespace {

// Pivots below this part of their column's diagonal are rounding errors.
constexpr double vanished = 1e-13;

}  // namespace

double log_det_information(const Problem& problem, const Values& values, const Order& order) {
  LinearSystem system = make_linear_system(problem);
  linearize(problem, values, {}, system);
  NormalEquations normal = normal_structure(system, order);
  form_normal_equations(system, {}, normal);
  if (normal.scalars() == 0) return 0;

  CholmodCommon cholmod;
  CholmodFactor factor = analyze(normal, cholmod.common);
  cholmod_sparse H = view(normal);
  cholmod_factorize(&H, factor.get(), &cholmod.common);
  if (cholmod.common.status < CHOLMOD_OK) throw computation_error("CHOLMOD ran out of memory");
  constexpr double singular = -std::numeric_limits<double>::infinity();
  if (factor->minor < factor->n) return singular;
  cholmod_change_factor(CHOLMOD_REAL, false, false, true, true, factor.get(), &cholmod.common);
  const auto* p = static_cast<const int*>(factor->p);
  const auto* x = static_cast<const double*>(factor->x);
  const auto* permutation = static_cast<const int*>(factor->Perm);
  double sum = 0;
  for (std::size_t k = 0; k < factor->n; ++k) {
    const double pivot = x[p[k]];  // of L D L^T
    const double diagonal = normal.numbers[normal.column_begin[permutation[k] + 1] - 1];
    if (!(pivot > vanished * diagonal)) return singular;
    sum += std::log(pivot);
  }
  return sum;
}

}  // namespace sg
