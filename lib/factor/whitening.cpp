#include "lib/factor/whitening.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "lib/factor/model.h"
#include "lib/geometry/triangle.h"

namespace sg {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_dim, max_dim>;

// Eigenvalues this far below zero, relative to the largest, are rounding of the numbers in the
// file.
constexpr double rounding = 1e-6;

}  // namespace

bool whitening(std::span<const double> triangle, int dim, double* U) {
  const auto W = symmetric<Matrix>(triangle, dim);
  Eigen::Map<Matrix> root(U, dim, dim);
  const Eigen::LLT<Matrix> cholesky(W);
  if (cholesky.info() == Eigen::Success) {
    root = cholesky.matrixU();
    return true;
  }
  if (W.isDiagonal(0) && (W.diagonal().array() >= 0).all()) {
    root = Matrix(W.diagonal().cwiseSqrt().asDiagonal());
    return true;
  }
  const Eigen::SelfAdjointEigenSolver<Matrix> spectrum(W);
  const auto& values = spectrum.eigenvalues();
  if (values[0] < -rounding * std::abs(values[dim - 1])) return false;
  root = values.cwiseMax(0).cwiseSqrt().asDiagonal() * spectrum.eigenvectors().transpose();
  return true;
}

}  // namespace sg
