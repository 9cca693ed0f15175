// The steps of an update (isam2.h), each in a file of its name.
#pragma once

#include "lib/solve/clique_tree.h"
#include "lib/solve/isam2.h"

namespace sg::solve {

// Steps 1 and 2 (isam2.cpp): linearizes the new rows and what has moved, and marks the cliques that this concerns.
// Returns how many variables moved.
Index begin_update(Isam2& isam, std::span<const Index> new_rows);

// Step 2, algorithm 5 of the paper (isam2_relinearize.cpp).

// Linearizes row r at the linearization points of its variables: its Gram matrix, and the least
// pivots that it calls for. A landmark seen along a ray is damped, and where it cannot be seen the
// row says nothing of it (landmark_point.h). Throws check_row's Error.
void linearize_factor(Isam2& isam, Index r);

// Moves the linearization points of the variables that have gone too far, linearizes their rows
// again, and marks the cliques in which these stand. Returns how many variables moved.
Index relinearize(Isam2& isam);

// Marks clique c (none for -1) and its ancestors, to be taken out.
void mark_to_root(Isam2& isam, Index c);
void mark_all(Isam2& isam);

// Takes a row, or a variable of which no row is left, out between begin_update and plan_top (isam2_top.cpp).
void take_row_out(Isam2& isam, Index r);
void take_variable_out(Isam2& isam, Index j);

// Step 3, algorithm 6 (isam2_top.cpp), and 4. Takes the marked cliques out, and eliminates their variables
// and the new ones again: rows that the cliques held, the new ones, and what the orphans pass up. The
// new cliques are left in work.made, children before parents. Then solves down, if nothing is undetermined. Reports all
// but how many variables moved.
//
// The plan says which cliques that would make, in numbers of work.variables, and changes nothing in the
// tree; it marks all cliques where many are. Where more cliques have been marked since, another is to be made.
//
// `last`: which of the new rows' variables are ordered last. All of them are at hand for the next update. Poses alone leave
// landmarks that few poses see at the bottom, for less EC_BT, but more of it is eliminated in every update.
enum class Last : std::uint8_t { all, poses };
CliqueTree plan_top(Isam2& isam, std::span<const Index> new_variables,
                    std::span<const Index> new_rows, Last last = Last::all);
void redo_and_solve(Isam2& isam, std::span<const Index> new_variables,
                    std::span<const Index> new_rows, const CliqueTree& plan, Isam2Report& report);

// Step 3c, algorithm 2 for all frontal variables at once (isam2_eliminate.cpp). Sums clique c's front
// up from its rows and its children's updates, and eliminates its frontal variables. Appends those of
// them with a pivot that vanished to `undetermined`.
void eliminate_clique(Isam2& isam, Index c, std::vector<Index>& undetermined);

// Step 4, algorithm 7 (isam2_solve.cpp). Solves from the new roots down to where steps change by less
// than the wildfire threshold, and brings the estimates up to date. False if one is not finite.
bool solve_down(Isam2& isam);

}  // namespace sg::solve
