// iSAM2: incremental smoothing on the Bayes tree.
//
// Every variable has a linearization point and a step from it; their sum is the estimate. The tree
// holds the elimination of the factors, linearized at these points. An update
//   - moves the linearization point of every variable whose step has grown beyond a threshold, and
//     linearizes its factors again (fluid relinearization);
//   - takes out the cliques that the new and the relinearized factors reach, with all their
//     ancestors, orders their variables anew, those of the new factors last, and eliminates them;
//     subtrees below stay: what a clique passes to its parent is kept with it;
//   - solves from the roots down to where steps no longer change by more than a threshold.
// Source: Kaess, Johannsson, Roberts, Ila, Leonard, Dellaert: iSAM2 (IJRR 2012), algorithms 3 to 8.
//
// All is laid out in flat arrays by variable, factor and clique; blocks of cliques that go serve
// those that come.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "lib/elim/score.h"
#include "lib/factor/linearize.h"
#include "lib/order/order.h"
#include "lib/solve/arena.h"
#include "lib/solve/front.h"
#include "lib/solve/pool.h"

namespace sg {

struct Isam2Options {
  double relinearize_threshold = 0.1;  // largest number of a step
  int relinearize_skip = 1;            // relinearize in every so-manieth update
  double wildfire_threshold = 0.001;   // smallest change of a step that is passed down
  std::string ordering = "colamd";     // of lib/order
};

// A clique of the tree. Its lists (frontal variables, then separator variables, each in elimination
// order, then rows) and its numbers (front.h: l, then u) lie in Isam2's arrays.
struct Isam2Clique {
  Index parent = -1;
  Index first_child = -1;
  Index next = -1, previous = -1;  // siblings
  Offset lists = 0;
  Index frontals = 0, separators = 0, rows = 0;
  Offset numbers = 0;
  int f = 0, s = 0;     // scalars
  std::int64_t ec = 0;  // share of EC_BT
  Index made = -1;      // in which update
  Index removed = -1;   // in which update
};

struct Isam2 {
  const Problem* problem = nullptr;  // outlives it
  Isam2Options options;
  Index updates = 0;

  // By variable; steps by scalar (Problem::step_at).
  Lists<> rows_of;                // all rows that a variable will ever have
  std::vector<Index> clique;      // where it is frontal, -1 before it enters
  std::vector<double> step;       // from the linearization point
  std::vector<double> told;       // step that was last passed down, within the wildfire threshold
  std::vector<double> floor;      // least pivot of every scalar
  std::vector<Index> changed;     // update that last passed its step down
  std::vector<bool> moved;        // is in `candidates`
  std::vector<bool> unseen;       // landmark with rows left out (landmark_point.h)
  std::vector<Index> candidates;  // with a step above the threshold, or unseen
  Values linearized;              // linearization points, by vertex as all Values
  Values estimate;

  // By row of the problem's pattern.
  std::vector<Index> row_clique;  // -1 before it enters
  std::vector<Index> row_update;  // that last linearized it
  std::vector<Offset> gram_at;    // m + 1
  std::vector<double> grams;      // [A b]'[A b] of every row

  std::vector<Isam2Clique> cliques;
  std::vector<Index> free_cliques;
  Pool list_pool;
  Pool number_pool{ChunkedArena::chunk};
  std::vector<Index> lists;
  ChunkedArena numbers;

  Index variables = 0;  // that have entered
  Index rows = 0;
  Wide ec_bt = 0;
  Index clique_count = 0;

  // Scratch of an update; kept so that nothing is allocated again.
  struct Work {
    std::vector<Index> removed, orphans, variables, rows, edges, last, stack, local, made;
    std::vector<int> row_at;
    std::vector<Run> runs;
    std::vector<double> numbers, floors;
    Pattern pattern;
  } work;
};

// An empty smoother for the problem's variables and rows. Throws a usage Error for an unknown
// ordering.
Isam2 make_isam2(const Problem& problem, const Isam2Options& options);

struct Isam2Report {
  Index reeliminated = 0;           // variables, new ones included
  Index relinearized = 0;           // variables
  std::vector<Index> undetermined;  // variables; the smoother is of no use afterwards
};

// Adds variables, whose `linearized` and `estimate` are set, and rows, each with one variable at
// least and all of them there; then brings the estimate up to date.
Isam2Report update(Isam2& isam, std::span<const Index> variables, std::span<const Index> rows);

// chi-square of the rows that are there, at the estimate.
double chi2(const Isam2& isam);

}  // namespace sg
