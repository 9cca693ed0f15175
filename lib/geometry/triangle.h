// Symmetric matrices as files write them: the upper triangle, row by row.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cassert>
#include <span>

namespace sg::geometry {

// Its entries for an n x n matrix.
template <class Integer>
constexpr Integer triangle_size(Integer n) {
  return n * (n + 1) / 2;
}

// The n x n matrix with this upper triangle.
template <class Matrix>
Matrix symmetric(std::span<const double> triangle, Eigen::Index n = Matrix::RowsAtCompileTime) {
  assert(std::ssize(triangle) >= triangle_size(n));
  Matrix matrix(n, n);
  std::size_t k = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = i; j < n; ++j) matrix(i, j) = matrix(j, i) = triangle[k++];
  }
  return matrix;
}

template <int N>
std::array<double, triangle_size(N)> upper_triangle(const Eigen::Matrix<double, N, N>& matrix) {
  std::array<double, triangle_size(N)> triangle{};
  std::size_t k = 0;
  for (int i = 0; i < N; ++i) {
    for (int j = i; j < N; ++j) triangle[k++] = matrix(i, j);
  }
  return triangle;
}

// Whether the n x n matrix with this upper triangle is diagonal.
inline bool is_diagonal(std::span<const double> triangle, int n) {
  std::size_t k = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = i; j < n; ++j, ++k) {
      if (i != j && triangle[k] != 0) return false;
    }
  }
  return true;
}

}  // namespace sg::geometry
