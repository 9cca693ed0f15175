// Sparse linear least squares by normal equations and CHOLMOD: the X, n x k, that minimizes a sum of
//     w |a' X - b'|^2,      a sparse, of n numbers, b of k: k problems with one matrix.
#pragma once

#include <span>
#include <vector>

#include "lib/sparse/cholesky.h"

namespace sg::sparse {

struct LeastSquares {
  LeastSquares(int n, int k) : unknowns(n), right(static_cast<std::size_t>(n) * k, 0) {}
  int unknowns;
  Triplets lower;             // of A' W A
  std::vector<double> right;  // A' W B, n x k, by column
};

struct Term {
  int unknown;
  double factor;
};
void add_square(LeastSquares& system, double w, std::span<const Term> a, std::span<const double> b);

// The factor of A' W A; its order is found once, for all matrices of one pattern.
struct NormalFactor {
  Cholmod session;
  CholmodFactor factor{nullptr, {nullptr}};
};
// What nothing determines is damped by a share of 1e-9 of the diagonal (by 1 where that is 0), which keeps it near 0.
// Throws a computation Error where that does not help: of numbers that are too far apart.
void factorize(LeastSquares& system, NormalFactor& normal);
// X for this right-hand side.
std::vector<double> solve(NormalFactor& normal, std::vector<double>& right);

}  // namespace sg::sparse
