// Information matrices of sums: what is known of d1 + d2 when d1 and d2 are independent.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/QR>

namespace sg {

// (A^-1 + B^-1)^-1, without the inverses: A (A + B)^+ B, which also holds for singular A and B (the
// parallel sum of Anderson and Duffin, 1969). A, B symmetric and positive semidefinite.
template <int N>
Eigen::Matrix<double, N, N> parallel_sum(const Eigen::Matrix<double, N, N>& a,
                                         const Eigen::Matrix<double, N, N>& b) {
  using Matrix = Eigen::Matrix<double, N, N>;
  const Matrix sum = a + b;
  const Eigen::LLT<Matrix> cholesky(sum);
  const bool regular = cholesky.info() == Eigen::Success && cholesky.rcond() > 1e-14;
  const Matrix quotient =
      regular ? Matrix(cholesky.solve(b)) : Matrix(sum.completeOrthogonalDecomposition().solve(b));
  const Matrix product = a * quotient;
  return (product + product.transpose()) / 2;
}

}  // namespace sg
