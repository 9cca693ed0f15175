// Sparse Cholesky factors by CHOLMOD (Chen, Davis, Hager, Rajamanickam, ACM TOMS 35, 2008): its C
// handles, owned, and its results, checked. The one place that calls it.
#pragma once

#include <cholmod.h>

#include <memory>
#include <vector>

namespace sg::sparse {

// A session: settings, workspace and the status of the last call. Outlives what is made in it.
struct Cholmod {
  Cholmod();
  ~Cholmod();
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;
  cholmod_common common;
};

template <auto Free>
struct FreeCholmod {
  cholmod_common* common;
  void operator()(auto* handle) const { Free(&handle, common); }
};
using CholmodFactor = std::unique_ptr<cholmod_factor, FreeCholmod<cholmod_free_factor>>;
using CholmodSparse = std::unique_ptr<cholmod_sparse, FreeCholmod<cholmod_free_sparse>>;
using CholmodDense = std::unique_ptr<cholmod_dense, FreeCholmod<cholmod_free_dense>>;

// All of these throw a computation Error where CHOLMOD fails: without memory, or at a matrix or
// factor too large for its 31-bit indices.

// Entries of a symmetric matrix, in its lower triangle; those of one place add up.
struct Triplets {
  std::vector<int> row, column;  // row >= column
  std::vector<double> value;
  void add(int i, int j, double x) { row.push_back(i), column.push_back(j), value.push_back(x); }
};
CholmodSparse sparse_matrix(int n, Triplets& lower, Cholmod& session);

// A symmetric matrix by its upper triangle, compressed by column, rows ascending: a view, no copy.
cholmod_sparse view(std::vector<int>& column_begin, std::vector<int>& rows,
                    std::vector<double>& numbers);

// The symbolic factor, under this ordering (CHOLMOD_NATURAL, CHOLMOD_AMD) and a postorder.
CholmodFactor analyze(cholmod_sparse& matrix, int ordering, Cholmod& session);

// The numbers. False for a matrix that is not positive definite.
bool factorize(cholmod_sparse& matrix, cholmod_factor& factor, Cholmod& session);

// x with A x = b, of one column or several, one behind the other.
CholmodDense solve(cholmod_factor& factor, std::vector<double>& b, Cholmod& session);

}  // namespace sg::sparse
