#include "lib/solve/scaled_qr.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "lib/solve/normal_equations.h"

namespace sg::solve {
namespace {

void append_block(const factor::LinearSystem& system, Index r, const std::vector<Index>& step_at,
                  const std::vector<double>& length, sparse::Entries& A, std::vector<double>& b) {
  const int height = system.height[r];
  const double* number = system.block(r);
  for (Index j : system.pattern->rows[r]) {
    for (Index k = step_at[j]; k < step_at[j + 1]; ++k) {
      for (int i = 0; i < height; ++i, ++number) {
        if (*number != 0) A.add(A.rows + i, k, *number / length[k]);
      }
    }
  }
  b.insert(b.end(), number, number + height);
  A.rows += height;
}

}  // namespace

ScaledQr scaled_qr(const factor::LinearSystem& system, std::span<const double> damping) {
  assert(factor::is_laid_out(system));
  const std::vector<Index> step_at = factor::starts(system.pattern->dim);
  ScaledQr result;
  std::vector<double> gradient;
  diagonal_and_gradient(system, result.length, gradient);
  for (std::size_t k = 0; k < damping.size(); ++k) result.length[k] += damping[k];
  for (double& length : result.length) length = length > 0 ? std::sqrt(length) : 1;

  sparse::Entries A;
  A.columns = step_at.back();
  std::vector<double> b;
  for (Index r = 0; r < system.pattern->rows.size(); ++r) {
    append_block(system, r, step_at, result.length, A, b);
  }
  for (std::size_t k = 0; k < damping.size(); ++k) {
    if (damping[k] > 0)
      A.add(A.rows++, static_cast<Index>(k), std::sqrt(damping[k]) / result.length[k]);
  }
  A.rows = std::max<std::int64_t>(A.rows, 1);  // SPQR wants one
  b.resize(A.rows, 0.0);
  result.qr = sparse::qr(A, b, dependent);
  return result;
}

}  // namespace sg::solve
