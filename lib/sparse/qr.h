// Sparse QR factorization with rank detection by SPQR (Davis, Algorithm 915, ACM TOMS 38, 2011):  A E = Q R.
//
// A is never squared, so that what depends on 1e8 digits apart is still told apart, where normal equations have lost it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace sg::sparse {

// Entries of a matrix; those of one place add up.
struct Entries {
  std::int64_t rows = 0, columns = 0;
  std::vector<std::int64_t> row, column;
  std::vector<double> value;
  void add(std::int64_t i, std::int64_t j, double x) {
    row.push_back(i), column.push_back(j), value.push_back(x);
  }
};

struct Qr {
  std::vector<std::int64_t> column;       // of A, by column of R
  std::vector<std::int64_t> begin, rows;  // R, compressed by column, rows ascending
  std::vector<double> numbers;
  std::vector<std::int64_t>
      pivot;                  // by column of R: the row whose diagonal it has, -1 for a dead one
  std::vector<double> right;  // Q' b
  std::int64_t dead = 0;      // columns that depend on those before them
};

// A column is dead if no more than `tolerance` of it stands out of those before it (Heath, 1982). Throws a computation
// Error where SPQR fails: without memory.
Qr qr(Entries& A, std::vector<double>& b, double tolerance);

// x, by column of A, with R x = right; at dead columns it is what `dead` says, in their order (empty: 0).
std::vector<double> back_substitute(const Qr& qr, std::vector<double> right,
                                    std::span<const double> dead = {});

}  // namespace sg::sparse
