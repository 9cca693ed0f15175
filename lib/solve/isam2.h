// iSAM2: incremental smoothing on the Bayes tree.
//
// The problem. Factors come in, update by update, with new variables. Wanted, after each, is
//
//     theta* = argmin  sum over factors i of |U_i e_i(theta)|^2       (linearize.h: the whitened error)
//
// Gauss-Newton linearizes all factors at one point and solves for a step. Here every variable j has
// a linearization point Theta_j of its own and a step Delta_j from it; the estimate is Theta (+)
// Delta. A factor is linearized at the points of its variables,
//
//     |A_i Delta_i - b_i|^2,   A_i = U_i J_i(Theta_i),   b_i = -U_i e_i(Theta_i),
//
// and stays so until one of them moves. The Delta that minimizes their sum solves  R Delta = d  with
// R'R = A'A, R'd = A'b; R is kept as a Bayes tree.
//
// The tree. A clique with frontal variables F and separator S holds the conditional density P(F | S),
//
//     L11' Delta_F = y - L21' Delta_S                          (front.h)
//
// and what eliminating F says of S, the update that its parent assembles. That is all that is known
// of a subtree above it: if the clique stays, everything below it stays. Separators lie within
// parents, so that the factors of a variable reach only the cliques from where it is frontal up to
// the root. There a change is local: loops apart, it concerns the top of the tree alone.
//
// An update (algorithm 8 of the paper) gets new variables Theta' with their starts, and factors F':
//
//   1  F := F + F';  Theta := Theta + Theta'.
//   2  Fluid relinearization (algorithm 5; isam2_relinearize.cpp). Where a number of Delta_j is beta or
//      more, Theta_j := Theta_j (+) Delta_j, Delta_j := 0, and j's factors are linearized again.
//      Marked are the cliques that hold these factors, or j as a frontal variable, with all
//      their ancestors; and those of the variables of F', with theirs.
//   3  The top is redone (algorithm 6, which is 4 with relinearized factors; isam2_top.cpp):
//      a  the marked cliques are taken out: they are all of the tree above some subtrees, the
//         orphans. Their variables and the new ones make a small factor graph of the factors that
//         the cliques held, F', and one factor for every orphan: its update.
//      b  It is ordered anew, the variables of F' last, so that the next update finds them at the
//         root (constrained COLAMD in the paper; here any ordering of lib/order that can do it).
//      c  It is eliminated to new cliques (algorithms 2 and 3; isam2_eliminate.cpp), children before
//         parents: lib/elim's Bayes tree says which variables share one, and a front is summed up
//         from its factors' Gram matrices [A b]'[A b] and its children's updates, as in batch.
//      d  The orphans are put below the cliques that assembled their updates.
//      If more than a fixed share of all variables would be redone, all are: a new ordering pays.
//   4  Delta is solved for from the roots down (algorithm 7; isam2_solve.cpp): every clique that was
//      made, or whose separator has a variable that changed by alpha or more since it was last
//      passed down (the wildfire threshold); below others nothing is touched.
//
// What is not in the paper. Landmarks seen along rays (pixels, bearings) are damped and their points
// moved with care (landmark_point.h). Pivots that vanish (pivots.h) are named, not divided by.
//
// Complexity. An update costs the EC of the cliques that it makes, plus orders of magnitude less for
// ordering them and for the descent. In the steady state nothing is allocated.
//
// Source: Kaess, Johannsson, Roberts, Ila, Leonard, Dellaert, iSAM2: Incremental smoothing and
// mapping using the Bayes tree, Int. J. Robotics Research 31 (2012); algorithms by its numbers.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lib/factor/linearize.h"
#include "lib/order/order.h"
#include "lib/solve/isam2_tree.h"
#include "lib/solve/pool.h"

namespace sg::solve {

struct Isam2Options {
  double relinearize_threshold = 0.1;  // beta: largest number of a step
  int relinearize_skip = 1;            // relinearize in every so-manieth update; 0: never
  double wildfire_threshold = 0.001;   // alpha: smallest change of a step that is passed down
  std::string ordering{order::default_ordering};
  order::Budget order_budget;  // of best, in every update
  int relaxed_from = 64;       // rows of a clique that may join its parent (clique_tree.h)
};

struct Isam2 {
  const factor::Problem* problem = nullptr;  // outlives it
  Isam2Options options;
  Index updates = 0;

  Isam2Tree tree;
  Index variables = 0;  // that have entered
  Index rows = 0;       // factors that have entered, the gauge's row included

  // By variable; steps by scalar (Problem::step_at).
  graph::Lists<> columns;         // rows as the problem has them (rows_of)
  factor::Values linearized;      // Theta, by vertex as all Values
  factor::Values estimate;        // Theta (+) Delta
  std::vector<double> step;       // Delta
  std::vector<double> told;       // Delta as it was last passed down
  std::vector<Index> changed;     // update that last passed it down
  std::vector<double> floor;      // least pivot of every scalar
  std::vector<bool> moved;        // is in `candidates`
  std::vector<bool> unseen;       // landmark with rows left out (landmark_point.h)
  std::vector<bool> leaving;      // with this update (isam2_leave.h)
  std::vector<bool> pinned;       // keeps its linearization point (isam2_leave.h)
  std::vector<Index> past;        // cliques kept of variables that have left, in that order
  std::vector<Index> candidates;  // with a step of beta or more, or unseen
  // Instead of `columns`, once a row has changed hands (isam2_keyframes.h).
  std::vector<std::vector<Index>> changed_rows;

  // By row of the problem's pattern.
  std::vector<Index> row_update;  // that last linearized it
  std::vector<bool> forgotten;    // goes with this update, and passes nothing on (isam2_turns.h)
  std::vector<Offset> gram_at;    // of a row that is there, in grams; -1 of others
  Pool gram_pool;
  std::vector<double> grams;  // [A b]'[A b]

  // Scratch of an update; kept so that nothing is allocated again.
  struct Work {
    std::vector<Index> marked;           // cliques to be taken out
    std::vector<Index> orphans;          // cliques below them
    std::vector<Index> variables, rows;  // of the top
    std::vector<Index> local;            // by variable: its place in `variables`
    graph::Pattern pattern;              // of the top
    std::vector<Index> made;             // cliques
    std::vector<int> row_at;             // by variable: its first row in the front at hand
    std::vector<Run> runs;
    std::vector<Index> edges, stack;
    std::vector<double> numbers, floors;
    std::vector<double> rhs;
  } work;
};

// An empty smoother for the problem's variables and rows. Throws a usage Error for an unknown
// ordering.
Isam2 make_isam2(const factor::Problem& problem, const Isam2Options& options);
Isam2 make_isam2(const factor::Problem&&, const Isam2Options&) = delete;

struct Isam2Report {
  Index reeliminated = 0;  // variables, new ones included
  Index relinearized = 0;  // variables
  elim::Wide ec = 0;       // sum over the cliques that were eliminated of d_f (d_f + d_s)^2
  // The smoother is of no use after either of these.
  std::vector<Index> undetermined;  // variables whose pivot vanished
  bool finite = true;               // the estimate
};

// Adds variables, whose `linearized` and `estimate` are set, and rows, each with one variable at
// least and all of them there; then brings the estimate up to date. Throws check_row's Error.
Isam2Report update(Isam2& isam, std::span<const Index> variables, std::span<const Index> rows);

// Room for a row's numbers, before it enters. A row that is there leaves, and gives room to others; so does one for which
// there was room, and which has not entered.
void hold_row(Isam2& isam, Index r);
void let_row_go(Isam2& isam, Index r);

// Rows of variable j that are there.
std::vector<Index> rows_in(const Isam2& isam, Index j);

// chi-square of the rows that are there, at the estimate. Throws finite_edge_chi2's Error.
double chi2(const Isam2& isam);

// The pattern of all that will ever come.
inline const graph::Pattern& pattern_of(const Isam2& isam) {
  return isam.problem->variables.pattern;
}

// All rows that variable j has, now or later.
inline std::span<const Index> rows_of(const Isam2& isam, Index j) {
  return isam.changed_rows.empty() ? isam.columns[j] : std::span<const Index>(isam.changed_rows[j]);
}

// The largest number of variable j's step.
double largest(const Isam2& isam, Index j);

// The next relinearization looks at variable j.
void propose(Isam2& isam, Index j);

}  // namespace sg::solve
