// The Bayes tree that an incremental smoother edits: cliques come and go with every update.
//
// All is laid out in flat arrays. A clique's lists (its frontal variables, then its separator's,
// each in elimination order, then its factors) lie side by side in `lists`, its numbers (front.h: l,
// then u, which is what it passes to its parent) in `numbers`; blocks of cliques that go serve those
// that come (pool.h). Children of a clique are a linked list, the latest first.
//
// A clique without frontal variables is a prior: what variables that have left (isam2_leave.h) passed
// to its separator. It stands below a clique, is never taken out, and is not counted.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lib/elim/score.h"
#include "lib/graph/pattern.h"
#include "lib/solve/arena.h"
#include "lib/solve/front.h"
#include "lib/solve/pool.h"

namespace sg::solve {

struct Isam2Clique {
  Index frontals = 0, separators = 0, rows = 0;
  int f = 0, s = 0;     // scalars of frontals and separators
  std::int64_t ec = 0;  // share of EC_BT
  Index merged = 1;     // cliques of the Bayes tree that it is made of
  Index made = -1;      // in which update
  Index marked = -1;    // in which update, to be taken out
  bool factor = false;  // forms no update: its parent takes its factor (assembly.h)

  Index parent = -1;
  Index first_child = -1;
  Index next = -1, previous = -1;  // siblings

  Offset lists = 0;
  Offset numbers = 0;
};

struct Isam2Tree {
  std::vector<Isam2Clique> cliques;
  std::vector<Index> free;  // places in `cliques` that hold none

  std::vector<Index> variable_clique;  // where a variable is frontal, -1 before it enters
  std::vector<Index> row_clique;       // where a factor is assembled, -1 before it enters

  Pool list_pool;
  std::vector<Index> lists;
  Pool number_pool{ChunkedArena::chunk};
  ChunkedArena numbers;

  Index count = 0;       // cliques of the Bayes tree
  elim::Wide ec_bt = 0;  // sum over them of d_f (d_f + d_s)^2
};

inline bool is_prior(const Isam2Clique& c) {
  return c.frontals == 0;
}
// Whether the place holds one.
inline bool is_there(const Isam2Clique& c) {
  return c.made >= 0;
}

inline std::span<Index> lists_of(Isam2Tree& tree, const Isam2Clique& c) {
  return std::span(tree.lists).subspan(c.lists, c.frontals + c.separators + c.rows);
}
inline std::span<const Index> frontals_of(const Isam2Tree& tree, const Isam2Clique& c) {
  return std::span(tree.lists).subspan(c.lists, c.frontals);
}
inline std::span<const Index> separators_of(const Isam2Tree& tree, const Isam2Clique& c) {
  return std::span(tree.lists).subspan(c.lists + c.frontals, c.separators);
}
inline std::span<const Index> rows_of(const Isam2Tree& tree, const Isam2Clique& c) {
  return std::span(tree.lists).subspan(c.lists + c.frontals + c.separators, c.rows);
}
Front front_of(Isam2Tree& tree, const Isam2Clique& c);

// Adds a clique of these sizes, alone, its lists and numbers not set: lists are to be filled in at
// once, numbers are there after grow_numbers().
Index add_clique(Isam2Tree& tree, const Isam2Clique& sizes);
void grow_numbers(Isam2Tree& tree);

// Gives back what a clique without a parent held.
void remove_clique(Isam2Tree& tree, Index c);
// It is no part of the tree any more, but keeps its lists and numbers.
void shelve_clique(Isam2Tree& tree, Index c);

// Puts a clique without a parent below one (nothing for -1), and takes it away from there.
void link(Isam2Tree& tree, Index c, Index parent);
void unlink(Isam2Tree& tree, Index c);

}  // namespace sg::solve
