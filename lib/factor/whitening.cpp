#include "lib/factor/whitening.h"

#include "lib/geometry/information.h"
#include "lib/geometry/triangle.h"

namespace sg::factor {
bool whitening(std::span<const double> triangle, int dim, double* U) {
  const auto W = geometry::symmetric<geometry::SmallMatrix>(triangle, dim);
  Eigen::Map<geometry::SmallMatrix> root(U, dim, dim);
  if (W.isDiagonal(0) && (W.diagonal().array() >= 0).all()) {
    root = geometry::SmallMatrix(W.diagonal().cwiseSqrt().asDiagonal());
    return true;
  }
  const geometry::SquareRoot found = geometry::square_root(W);
  root = found.U;
  return !(found.least < -geometry::semidefinite_rounding);
}

}  // namespace sg::factor
