#include "lib/factor/whitening.h"

#include "lib/geometry/information.h"
#include "lib/geometry/triangle.h"

namespace sg::factor {
namespace {

// Eigenvalues this far below zero, relative to the largest, are rounding of the numbers in the
// file.
constexpr double rounding = 1e-6;

}  // namespace

bool whitening(std::span<const double> triangle, int dim, double* U) {
  const auto W = geometry::symmetric<geometry::SmallMatrix>(triangle, dim);
  Eigen::Map<geometry::SmallMatrix> root(U, dim, dim);
  if (W.isDiagonal(0) && (W.diagonal().array() >= 0).all()) {
    root = geometry::SmallMatrix(W.diagonal().cwiseSqrt().asDiagonal());
    return true;
  }
  const geometry::SquareRoot found = geometry::square_root(W);
  root = found.U;
  return !(found.least < -rounding);
}

}  // namespace sg::factor
