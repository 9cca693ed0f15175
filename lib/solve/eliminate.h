// Multifrontal Cholesky elimination of a linearized system on its Bayes tree.
//
// The step d that minimizes |A d - b|^2 comes from R' R = A' A (+ diag(damping)): every clique of
// the tree gathers the Gram matrices of its factors and the updates of its children in a dense
// front (front.h), eliminates its frontal variables, and passes the rest up; then every clique,
// roots first, solves for its frontal variables given its separator's.
//
// A leaf of few frontal scalars, as a landmark is, forms no update: its parent takes the outer
// product of its L21 straight from its own front, and assembles the rest of its rows.
//
// What depends on the structure alone is planned once; linearizing and eliminating again writes
// over the same numbers and allocates nothing. Updates live on two stacks, one for cliques of even
// depth and one for those of odd depth, so that children lie on top of the one while their parent
// is put on the other. With several threads, disjoint subtrees have stacks of their own; the sums
// in a front are taken in the same order by any number of threads.
//
// Source: Duff and Reid (1983); Liu, The multifrontal method for sparse matrix solution (1992);
// Dellaert and Kaess, Square Root SAM (2006).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lib/factor/linearize.h"
#include "lib/solve/arena.h"
#include "lib/solve/clique_tree.h"
#include "lib/solve/front.h"

namespace sg::solve {

struct Elimination {
  CliqueTree tree;
  std::vector<int> dim;         // n, of every variable
  std::vector<Index> step_at;   // n + 1: where a variable's part of a step starts
  std::vector<Index> floor_at;  // n: where its pivots' floors are, in elimination order

  std::vector<Offset> l_at;      // C, into conditionals
  std::vector<Offset> u_at;      // C, into updates; -1 where none is formed
  graph::Lists<> rows;           // C: what is assembled in every clique
  graph::Lists<> children;       // C
  graph::Lists<Run> row_runs;    // by place in rows: from the Gram matrix to the front
  graph::Lists<Run> child_runs;  // by place in children: from its update to the front
  graph::Lists<> rest;           // C: rows of children without an update
  graph::Lists<Run> rest_runs;   // by place in rest: all but the child's frontal variables

  // Consecutive cliques that one thread works through; a task's parent waits for it.
  struct Task {
    Index first, last;
    Index parent;  // -1
    int children;
  };
  std::vector<Task> tasks;
  int threads = 1;

  Arena conditionals;
  Arena updates;
  std::size_t scratch_size = 0;  // what assembling one row, or a clique's numbers, needs
  Arena scratch;                 // as much for every thread
  std::vector<double> floors;    // n scalars, in elimination order

  Front front(Index c) {
    const int f = tree.frontal_dim[c];
    return {conditionals.data() + l_at[c], u_at[c] < 0 ? nullptr : updates.data() + u_at[c], f,
            f + tree.separator_dim[c] + 1};
  }
};

// For this system and all of its structure. Throws std::invalid_argument if `order` is no
// permutation.
Elimination plan_elimination(const factor::LinearSystem& system, const graph::Order& order,
                             int threads = 1);

// Eliminates all variables. damping: what is added to the diagonal of A' A, by scalar of a step;
// empty for nothing. Returns the undetermined variables, ascending: those with a scalar whose pivot
// vanished next to the diagonal entry that it came from. They are held at zero in what follows.
std::vector<Index> eliminate(Elimination& elimination, const factor::LinearSystem& system,
                             std::span<const double> damping = {});

// Both, once; nothing where a variable is undetermined.
std::optional<Elimination> eliminated(const factor::LinearSystem& system,
                                      const graph::Order& order);

// After eliminate: the step, by variable (step_at).
void back_substitute(Elimination& elimination, std::vector<double>& step);

// After eliminate, of a regular system: log det(A' A + diag(damping)).
double log_determinant(Elimination& elimination);

}  // namespace sg::solve
