// The linearized system: the step d that minimizes
//     sum over rows r of  | A_r d - b_r |^2,       A_r = U J,  b_r = -U e,
// with the whitened Jacobian and error of factor r (model.h) at the current estimate. It is kept
// factor by factor in flat arrays: nothing is allocated per factor, and linearizing again writes
// over the same numbers.
//
// The block of row r is the matrix [A_r b_r], by column, of height[r] rows; its columns are those
// of the variables pattern.rows[r] in that order (dim of each), then b_r. Its Gram matrix, [A b]' [A
// b], is the factor's share of the normal equations.
#pragma once

#include <span>
#include <vector>

#include "lib/factor/kernel.h"
#include "lib/factor/problem.h"

namespace sg::factor {

struct LinearSystem {
  const graph::Pattern* pattern = nullptr;  // of the problem it was made for: variables and rows
  std::vector<int> height;                  // rows of every block
  std::vector<Offset> begin;                // of every block in numbers, and the end
  std::vector<double> numbers;

  const double* block(Index r) const { return numbers.data() + begin[r]; }
  double* block(Index r) { return numbers.data() + begin[r]; }
};

// Rows and columns of row r's block; columns with b.
int block_rows(const Problem& problem, Index r);
int block_columns(const graph::Pattern& pattern, Index r);

// Whether blocks follow one another, each as large as its row of the pattern says.
bool is_laid_out(const LinearSystem& system);

// Its structure, with all numbers zero.
LinearSystem make_linear_system(const Problem& problem);
LinearSystem make_linear_system(const Problem&&) = delete;

// Row r of the system at `values`: writes its block, height x (columns + 1) numbers. Rows beyond
// the edges: the gauge's. Thread-safe; allocates nothing but for linear factors.
void linearize_row(const Problem& problem, const Values& values, const Loss& loss, Index r,
                   double* block);

// Throws a computation Error at the line of edge r if a number of its block is not finite (where an
// observer and what it observes coincide, or a point lies in a camera's plane, an edge has no
// derivative), or so large that a sum of squares might not be.
void check_row(const Problem& problem, Index r, std::span<const double> block);
constexpr double largest_entry = 1e140;

// All rows, in parallel, and checked.
void linearize(const Problem& problem, const Values& values, const Loss& loss,
               LinearSystem& system);

// A system with its numbers.
LinearSystem linearized(const Problem& problem, const Values& values, const Loss& loss = {});
LinearSystem linearized(const Problem&&, const Values&, const Loss& loss = {}) = delete;

// e' W e of one edge, and its sum over all edges (with a loss: of rho), those between fixed
// vertices included.
double edge_chi2(const Problem& problem, const Values& values, Index e);
double chi2(const Problem& problem, const Values& values, const Loss& loss = {});

// The same for who prints them: throw a computation Error at the line of the first edge whose e' W e
// is not finite.
double finite_edge_chi2(const Problem& problem, const Values& values, Index e);
double finite_chi2(const Problem& problem, const Values& values, const Loss& loss = {});

}  // namespace sg::factor
