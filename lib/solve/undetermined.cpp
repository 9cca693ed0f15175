#include "lib/solve/undetermined.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <random>

#include "lib/solve/normal_equations.h"
#include "lib/sparse/cholesky.h"

namespace sg {
namespace {

constexpr std::size_t most_ranges = 20;  // in a message
constexpr double held_pivot = 1e-12;     // what a vanished pivot becomes, beside entries of 1
constexpr double noticeable = 1e-6;      // share of the largest movement

// H := S H S with a unit diagonal. A scalar that nothing measures gets none: its pivot will vanish.
void scale_to_unit_diagonal(NormalEquations& normal) {
  std::vector<double> scale(normal.scalars());
  for (int k = 0; k < normal.scalars(); ++k) {
    const double diagonal = normal.numbers[normal.column_begin[k + 1] - 1];
    scale[k] = diagonal > 0 ? 1 / std::sqrt(diagonal) : 0;
  }
  for (int k = 0; k < normal.scalars(); ++k) {
    for (int at = normal.column_begin[k]; at < normal.column_begin[k + 1]; ++at) {
      normal.numbers[at] *= scale[k] * scale[normal.rows[at]];
    }
  }
}

// The largest movement among each variable's scalars.
std::vector<double> movements(const NormalEquations& normal, const double* x) {
  std::vector<double> largest;
  for (std::size_t j = 0; j < normal.dim.size(); ++j) {
    const double* const first = x + normal.scalar_at[j];
    largest.push_back(0);
    for (int k = 0; k < normal.dim[j]; ++k) {
      largest.back() = std::max(largest.back(), std::abs(first[k]));
    }
  }
  return largest;
}

}  // namespace

std::vector<Index> undetermined_variables(const LinearSystem& system, const Order& order) {
  assert(!order.empty());
  NormalEquations normal = normal_structure(system, order);
  form_normal_equations(system, {}, normal);
  scale_to_unit_diagonal(normal);
  std::mt19937 bits(1);
  for (double& number : normal.gradient) number = 0.5 + bits() / (2.0 * std::mt19937::max());

  Cholmod session;
  session.common.supernodal = CHOLMOD_SIMPLICIAL;
  session.common.dbound = held_pivot;
  cholmod_sparse H = view(normal.column_begin, normal.rows, normal.numbers);
  const CholmodFactor factor = analyze(H, CHOLMOD_NATURAL, session);
  factorize(H, *factor, session);
  const CholmodDense x = solve(*factor, normal.gradient, session);

  const auto moved = movements(normal, static_cast<const double*>(x->x));
  const double limit = noticeable * *std::ranges::max_element(moved);
  std::vector<Index> undetermined;
  for (std::size_t j = 0; j < moved.size(); ++j) {
    if (moved[j] > limit) undetermined.push_back(static_cast<Index>(j));
  }
  return undetermined;
}

std::string id_ranges(const std::vector<Id>& ids) {
  std::vector<std::string> parts;
  std::size_t first = 0;
  while (first < ids.size() && parts.size() < most_ranges) {
    std::size_t last = first;
    while (last + 1 < ids.size() && ids[last + 1] == ids[last] + 1) ++last;
    if (last == first + 1) last = first;  // two are no range
    const std::string from = std::to_string(ids[first]);
    parts.push_back(last == first ? from : from + "-" + std::to_string(ids[last]));
    first = last + 1;
  }
  if (first < ids.size()) parts.push_back(std::to_string(ids.size() - first) + " more");
  std::string text = ids.size() == 1 ? "vertex " : "vertices ";
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (k > 0) text += k + 1 == parts.size() ? " and " : ", ";
    text += parts[k];
  }
  return text;
}

}  // namespace sg
