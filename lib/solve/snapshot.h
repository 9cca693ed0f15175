// What an incremental smoother holds, as a system of its own: for scoring it, and for eliminating it
// in batch.
#pragma once

#include <vector>

#include "lib/solve/isam2.h"

namespace sg::solve {

// Its system points to its pattern: it stays where it is.
struct Snapshot {
  Snapshot() = default;
  Snapshot(const Snapshot&) = delete;
  Snapshot& operator=(const Snapshot&) = delete;

  std::vector<Index> variable;  // of the problem, ascending
  std::vector<Index> row;       // of the problem, by row of `anchored`
  graph::Pattern pattern;       // of the edges, as a score has it, then of the tree's priors
  graph::Pattern anchored;      // with the gauge's row, if there is one, at the end
  factor::LinearSystem system;  // of `anchored`, at the linearization points
};

// Overwrites `snapshot`. numbers: whether the system is wanted, too.
void take_snapshot(const Isam2& isam, bool numbers, Snapshot& snapshot);

// Linearizes the system of such a snapshot elsewhere. Throws check_row's Error.
void linearize_at(const factor::Problem& problem, const factor::Values& values, Snapshot& snapshot);

}  // namespace sg::solve
