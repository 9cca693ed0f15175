// Where factors and updates go in a front (front.h): what the batch and the incremental solver share
// of summing one up.
#pragma once

#include <span>
#include <vector>

#include "lib/graph/pattern.h"
#include "lib/solve/front.h"

namespace sg::solve {

// Sets row_at, by variable, to the front row that its scalars start at: frontals, then separators.
// Returns the row behind them, which is the right-hand side's.
int place_variables(std::span<const Index> frontals, std::span<const Index> separators,
                    std::span<const int> dim, std::span<int> row_at);

// Appends the runs of a matrix over `variables`, in that order, and the right-hand side, to the
// front where they stand at row_at and last_row; variables at -1 are left out. They ascend in `to`;
// returns whether they do in `from`, too. Its last run ends with the right-hand side.
bool append_runs(std::span<const Index> variables, std::span<const int> dim,
                 std::span<const int> row_at, int last_row, std::vector<Run>& runs);

// Rows of the matrix that such runs, of one list, are of.
inline int rows_covered(std::span<const Run> runs) {
  return runs.back().from + runs.back().length;
}

// Whether a leaf of f frontal and s separator scalars is kept as its factor, and forms no update. A
// landmark's would be s^2 numbers of rank 3: they cost more to write and to read than to work out
// again.
inline bool stays_factor(int f, int s) {
  return f <= 8 && s > 8 * f;
}

// Adds what a child says of its separator: its update, or, if it forms none, what its factor takes
// away. The rest of its rows is to be added to the front as rows are.
void add_child(const Kernels& kernel, const Front& child, std::span<const Run> runs,
               const Front& front);

// Sets the front to a child's update: the quicker way to begin its sum, where a child has one.
inline void start_with(const Kernels& kernel, const Front& child, std::span<const Run> runs,
                       const Front& front) {
  kernel.set(front, child.u, child.ld_u(), runs.data(), static_cast<int>(runs.size()));
}

}  // namespace sg::solve
