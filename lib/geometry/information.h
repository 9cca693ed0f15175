// What is done with information matrices, symmetric and positive semidefinite: what is known of a sum, square roots, and
// systems that may be singular. The decompositions behind it take seconds to compile, and are compiled here alone.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace sg::geometry {

// (A^-1 + B^-1)^-1, without the inverses: A (A + B)^+ B, which also holds for singular A and B (the parallel sum of
// Anderson and Duffin, 1969). It is what is known of d1 + d2 when d1 and d2 are independent.
Eigen::Matrix3d parallel_sum(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b);
Eigen::Matrix<double, 6, 6> parallel_sum(const Eigen::Matrix<double, 6, 6>& a,
                                         const Eigen::Matrix<double, 6, 6>& b);

// Up to six dimensions, those of a motion in space; no memory of their own.
constexpr int small_size = 6;
using SmallMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, small_size, small_size>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, small_size, 1>;

// A^+ b: of all x that bring A x nearest to b the shortest.
SmallVector least_norm_solution(const SmallMatrix& a, const SmallVector& b);

// U with U' U = W: Cholesky's triangle where W is regular, sqrt(D) V' where it is not (W = V D V').
template <class Matrix>
struct SquareRoot {
  Matrix U;
  bool regular;
  double
      least;  // of a singular W: the least of its eigenvalues, over the largest one's size; below 0 they count as 0
};
SquareRoot<SmallMatrix> square_root(const SmallMatrix& W);
SquareRoot<Eigen::MatrixXd> square_root(const Eigen::MatrixXd& W);

// Eigenvalues this far below zero, relative to the largest, are rounding of the numbers in a file.
constexpr double semidefinite_rounding = 1e-6;

// The upper triangle R with R' R = W; nothing where W is not positive semidefinite.
std::optional<SmallMatrix> triangular_square_root(const SmallMatrix& W);

}  // namespace sg::geometry
