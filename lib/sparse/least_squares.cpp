#include "lib/sparse/least_squares.h"

#include "lib/text/error.h"

namespace sg::sparse {
namespace {

constexpr double damping = 1e-9;

void damp(LeastSquares& system) {
  Triplets& lower = system.lower;
  std::vector<double> diagonal(system.unknowns, 0);
  for (std::size_t k = 0; k < lower.value.size(); ++k) {
    if (lower.row[k] == lower.column[k]) diagonal[lower.row[k]] += lower.value[k];
  }
  for (int i = 0; i < system.unknowns; ++i)
    lower.add(i, i, diagonal[i] > 0 ? damping * diagonal[i] : 1);
}

bool try_to_factorize(LeastSquares& system, NormalFactor& normal) {
  const CholmodSparse matrix = sparse_matrix(system.unknowns, system.lower, normal.session);
  if (!normal.factor) normal.factor = analyze(*matrix, CHOLMOD_AMD, normal.session);
  return factorize(*matrix, *normal.factor, normal.session);
}

}  // namespace

void add_square(LeastSquares& system, double w, std::span<const Term> a,
                std::span<const double> b) {
  for (const Term& s : a) {
    for (const Term& t : a) {
      if (s.unknown >= t.unknown) system.lower.add(s.unknown, t.unknown, w * s.factor * t.factor);
    }
    for (std::size_t k = 0; k < b.size(); ++k)
      system.right[k * system.unknowns + s.unknown] += w * s.factor * b[k];
  }
}

void factorize(LeastSquares& system, NormalFactor& normal) {
  normal.session.common.quick_return_if_not_posdef = 1;
  if (system.unknowns == 0 || try_to_factorize(system, normal)) return;
  damp(system);
  normal.factor.reset();  // the diagonal may be fuller
  if (!try_to_factorize(system, normal))
    throw text::computation_error("a linear system is too badly scaled to be solved");
}

std::vector<double> solve(NormalFactor& normal, std::vector<double>& right) {
  if (right.empty()) return {};
  const CholmodDense x = solve(*normal.factor, right, normal.session);
  const auto* numbers = static_cast<const double*>(x->x);
  return {numbers, numbers + right.size()};
}

}  // namespace sg::sparse
