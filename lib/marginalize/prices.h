// What a pair of a Markov blanket costs the whole graph that is left, and which pairs are worth it.
//
// A measurement between two vertices costs the increase of EC that it makes in a fixed order of what is left
// (lib/elim/filled_graph.h), and what a factor costs beside elimination. It is worth what the pairs so far are wrong
// about it: the divergence of the pair's own Gaussian from theirs, in nats. So there is one exchange rate, nats a unit
// of EC, and in every blanket the pairs are taken by worth a cost as long as they are above it, and there are no more of
// them than the tree has: the sum of divergence and rate times EC falls with each. What stands within the filled graph comes for next to nothing.
#pragma once

#include <vector>

#include "lib/elim/filled_graph.h"
#include "lib/graph/pattern.h"
#include "lib/marginalize/topology.h"

namespace sg::marginalize {

struct Prices {
  elim::FilledGraph filled;  // of what is left, as far as it is known
  std::vector<Index>
      position;  // of every vertex in the order; -1 of constants, going of what goes in its turn
  double rate;   // nats that a unit of EC has to bring
  elim::Wide average;  // EC for each factor
};
constexpr Index going = -2;
// left: what is there in any case. order: of its variables.
Prices prices(const graph::GraphPattern& left, const graph::Order& order,
              const std::vector<bool>& removed, double rate);

// By how much EC grows with it; where an end goes in its turn, what a factor costs on average, as nobody knows yet what
// that will leave.
elim::Wide price(Prices& prices, const Measurable& of);
// Adds it.
void pay(Prices& prices, const Measurable& of);

// The pairs beside the tree's that are worth their price; all of them paid, the tree's too.
std::vector<Index> worth_their_price(const Blanket& blanket, const std::vector<Pair>& pairs,
                                     const Tree& tree, Prices& prices);

}  // namespace sg::marginalize
