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
// front where they stand at row_at and last_row. They ascend in `to`; returns whether they do in
// `from`, too. Its last run ends with the right-hand side.
bool append_runs(std::span<const Index> variables, std::span<const int> dim,
                 std::span<const int> row_at, int last_row, std::vector<Run>& runs);

// Rows of the matrix that such runs, of one list, cover.
inline int rows_covered(std::span<const Run> runs) {
  return runs.back().from + runs.back().length;
}

}  // namespace sg::solve
