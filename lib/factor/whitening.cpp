#include "lib/factor/whitening.h"

#include "lib/geometry/information.h"
#include "lib/geometry/triangle.h"

namespace sg::factor {
namespace {

template <class Matrix>
bool whiten(std::span<const double> triangle, int dim, double* U) {
  const auto W = geometry::symmetric<Matrix>(triangle, dim);
  Eigen::Map<Matrix> root(U, dim, dim);
  if (W.isDiagonal(0) && (W.diagonal().array() >= 0).all()) {
    root = Matrix(W.diagonal().cwiseSqrt().asDiagonal());
    return true;
  }
  const auto found = geometry::square_root(W);
  root = found.U;
  return !(found.least < -geometry::semidefinite_rounding);
}

}  // namespace

bool whitening(std::span<const double> triangle, int dim, double* U) {
  return dim <= geometry::small_size ? whiten<geometry::SmallMatrix>(triangle, dim, U)
                                     : whiten<Eigen::MatrixXd>(triangle, dim, U);
}

}  // namespace sg::factor
