#include "lib/geometry/information.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace sg::geometry {
namespace {

template <class Matrix>
Matrix sum_information(const Matrix& a, const Matrix& b) {
  const Matrix sum = a + b;
  const Eigen::LLT<Matrix> cholesky(sum);
  const bool regular = cholesky.info() == Eigen::Success && cholesky.rcond() > 1e-14;
  const Matrix quotient =
      regular ? Matrix(cholesky.solve(b))
              : Matrix(SmallMatrix(sum).completeOrthogonalDecomposition().solve(SmallMatrix(b)));
  const Matrix product = a * quotient;
  return (product + product.transpose()) / 2;
}

template <class Matrix>
SquareRoot<Matrix> root_of(const Matrix& W) {
  const Eigen::LLT<Matrix> cholesky(W);
  if (cholesky.info() == Eigen::Success) return {cholesky.matrixU(), true, 0};
  const Eigen::SelfAdjointEigenSolver<Matrix> spectrum(W);
  const auto& values = spectrum.eigenvalues();
  return {values.cwiseMax(0).cwiseSqrt().asDiagonal() * spectrum.eigenvectors().transpose(), false,
          values[0] / std::abs(values[values.size() - 1])};
}

}  // namespace

Eigen::Matrix3d parallel_sum(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return sum_information(a, b);
}

Eigen::Matrix<double, 6, 6> parallel_sum(const Eigen::Matrix<double, 6, 6>& a,
                                         const Eigen::Matrix<double, 6, 6>& b) {
  return sum_information(a, b);
}

SmallVector least_norm_solution(const SmallMatrix& a, const SmallVector& b) {
  return a.completeOrthogonalDecomposition().solve(b);
}

SquareRoot<SmallMatrix> square_root(const SmallMatrix& W) {
  return root_of(W);
}
SquareRoot<Eigen::MatrixXd> square_root(const Eigen::MatrixXd& W) {
  return root_of(W);
}

std::optional<SmallMatrix> triangular_square_root(const SmallMatrix& W) {
  const auto root = square_root(W);
  if (root.regular) return root.U;
  if (root.least < -semidefinite_rounding) return std::nullopt;
  const Eigen::HouseholderQR<SmallMatrix> qr(root.U);
  return SmallMatrix(qr.matrixQR().triangularView<Eigen::Upper>());
}

}  // namespace sg::geometry
