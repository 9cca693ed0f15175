// Polishing: a finished order made better, part by part, and never worse.
//
// Its elimination tree is cut into regions (region.h) that cover it. What a region costs depends on no other region's
// order, so that each is a small problem of its own: the order that minimum fill gives it, knowing what is around it
// (fill_graph.h), and where it is wide, dissection's, take the place of the one it has wherever they cost less. All regions
// of a cut go at a time, on all threads. Cuts of several sizes follow one another, so that what lay across a border lies
// within the next; sweeps go on while they gain.
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
  // Whether there is no time for what takes about so many seconds: asked before every sweep, and before every region
  // (with 0) by any thread. May be empty.
  std::function<bool(double seconds)> stop = {};
  int sweeps = 12;  // at most
};

struct Polished {
  graph::Order order;
  elim::Wide ec;
};
Polished polish(const graph::Pattern& pattern, const graph::Order& order,
                const PolishOptions& options = {});

}  // namespace sg::order
