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

struct Elimination {
  graph::Order order;  // postordered
  elim::OrderedPattern pattern;
  std::vector<Index> parent, first;
  std::vector<std::int64_t> count;  // d_f + d_s
  elim::Wide ec = 0;
};
// The elimination of a pattern in this order, made a postorder: every front stays as it is.
Elimination elimination(const graph::Pattern& pattern, const graph::Order& order);

// What an order gives for the positions of R alone.
struct Region {
  Index root;
  std::vector<Index> inside;  // R, ascending; ends with the root
  graph::Pattern pattern;     // variables: R as in `inside`, then B
  elim::Wide ec;              // of R, as it is
};

// Up to `size` positions at the top of the root's subtree, those with the largest fronts first.
Region region(const Elimination& elimination, Index root, Index size);

// The whole elimination, cut into regions of up to `size` positions: from the roots down, each the top of what hangs below
// others. Positions marked in `left_out`, with those above them, are in none. All may be reordered at a time: none has
// any part in another's pattern but by what hangs below, which stays as a whole.
std::vector<Region> cut(const Elimination& elimination, Index size,
                        const std::vector<bool>& left_out);
// The elimination order with every region of a cut reordered, orders[k] of regions[k]. Empty: as it is.
graph::Order recut(const Elimination& elimination, const std::vector<Region>& regions,
                   const std::vector<graph::Order>& orders);

// The elimination cut into its Bayes tree's cliques, for variables that are not left out, as in cut().
std::vector<Region> cliques(const Elimination& elimination, const std::vector<bool>& left_out);

// The same, but for pairs of a clique and one of its children that make one region:
// pairs that would cost less with the parent's variables before the child's. `orders` has that order of each pair, and
// nothing for cliques alone, which have no pattern here.
std::vector<Region> exchanges(const Elimination& elimination, const std::vector<bool>& left_out,
                              std::vector<graph::Order>& orders);

// EC of R under an order of region.pattern that has R before B.
elim::Wide region_ec(const Region& region, const graph::Order& order);

// The subtree's part of the elimination order, with R at its end and reordered.
std::vector<Index> reordered_subtree(const Elimination& elimination, const Region& region,
                                     const graph::Order& order);

}  // namespace sg::order
