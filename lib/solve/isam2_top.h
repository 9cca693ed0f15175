// Redoing the top of the tree (isam2.h, step 3): algorithm 6 of the paper.
#pragma once

#include "lib/solve/isam2.h"

namespace sg::solve {

// Takes the marked cliques out, and eliminates their variables and the new ones again: rows that the
// cliques held, the new ones, and what the orphans pass up. The new cliques are left in work.made,
// children before parents. Reports reeliminated and undetermined variables.
void redo_top(Isam2& isam, std::span<const Index> new_variables, std::span<const Index> new_rows,
              Isam2Report& report);

}  // namespace sg::solve
