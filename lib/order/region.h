// A part of an elimination that can be reordered by itself (see best.cpp).
//
// Here variables are called by their position in a postordered elimination, so that the subtree of
// k is [first[k], k].
#pragma once

#include <cstdint>
#include <vector>

#include "lib/elim/etree.h"
#include "lib/elim/score.h"

namespace sg::order {

struct OrderedElimination {
  graph::Order order;  // postordered
  elim::OrderedPattern pattern;
  std::vector<Index> parent, first;
  std::vector<std::int64_t> count;  // d_f + d_s
  elim::Wide ec = 0;
};
// The elimination of a pattern in this order, made a postorder: every front stays as it is.
OrderedElimination elimination(const graph::Pattern& pattern, const graph::Order& order);

// What an order gives for the positions of R alone.
struct Region {
  Index root;
  std::vector<Index> inside;  // R, ascending; ends with the root
  graph::Pattern pattern;     // variables: R as in `inside`, then B
  elim::Wide ec;              // of R, as it is
};

// Up to `size` positions at the top of the root's subtree, those with the largest fronts first.
Region region(const OrderedElimination& elimination, Index root, Index size);

// EC of R under an order of region.pattern that has R before B.
elim::Wide region_ec(const Region& region, const graph::Order& order);

// The subtree's part of the elimination order, with R at its end and reordered.
std::vector<Index> reordered_subtree(const OrderedElimination& elimination, const Region& region,
                                     const graph::Order& order);

}  // namespace sg::order
