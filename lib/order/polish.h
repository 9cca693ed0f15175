// Polishing: a finished order made better, part by part, and never worse.
//
// Its elimination tree is cut into regions (region.h) that cover it. What a region costs depends on no other region's
// order, so that each is a small problem of its own: the order that minimum fill gives it, knowing what is around it
// (fill_graph.h), and where it is wide, dissection's, take the place of the one it has wherever they cost less. All regions
// of a cut go at a time, on all threads. Cuts of several sizes follow one another, so that what lay across a border lies
// within the next. Then adjacent cliques of the Bayes tree are exchanged where the parent had better go first, which a
// greedy order does not see; rounds go on while they gain.
//
// At last what fill no triangulation needs is taken back: where the edges that a clique's frontal variables must have, those
// of the graph and those within the separators below it, do not join all of it, its own order is at fault. Once every clique
// is joined by such edges the triangulation is minimal (Rose, Tarjan, Lueker 1976; Blair, Heggernes, Telle, A practical
// algorithm for making filled graphs minimal, 2001). Less than a hundredth of the public graphs' fill is of that kind.
//
// Deterministic. Time: a sweep takes about what wmf takes of the whole, or less.
#pragma once

#include <functional>
#include <vector>

#include "lib/elim/score.h"
#include "lib/graph/pattern.h"

namespace sg::order {

struct PolishOptions {
  std::vector<Index> last;  // variables that stay behind all others, where the order has them
  // Whether there is no time for what takes about so many seconds: asked before every sweep, and before every region by any
  // thread. May be empty.
  std::function<bool(double seconds)> stop = {};
  int rounds = 6;  // at most, each of sweeps of all sizes and exchanges
};

struct Polished {
  graph::Order order;
  elim::Wide ec;
};
Polished polish(const graph::Pattern& pattern, const graph::Order& order,
                const PolishOptions& options = {});

}  // namespace sg::order
