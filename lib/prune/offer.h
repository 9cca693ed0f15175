// Moves that could be made: an edge, or a landmark that is not in with as many of its observations as pay.
#pragma once

#include <optional>

#include "lib/prune/part.h"

namespace sg::prune {

constexpr elim::Wide edge_cost = 100;

struct Offer {
  std::vector<Index> edges;  // candidates that come in
  std::vector<Index> rows;   // and what else does
  Index landmark = -1;       // variable that comes in with them
  Measurement measurement = {};
  std::optional<Tried> tried = {};
};

// What a move is worth: its gain per increase of EC and cost of its edges.
double worth(Part& part, const Offer& offer, const Gain& gain);
double guessed_worth(Part& part, const Offer& offer);

Offer edge_offer(const Part& part, Index e);

// The best way for a landmark that is not in, by what is guessed of it: all of its `candidates` among the edges whose
// other vertices are in, or those beside one of them, so many, spread evenly; and with them `others`, that it has anyhow.
// Two bearings determine a point and say nothing else: it takes more than the fewest. Nothing where it is not determined.
struct Valued {
  Offer offer;
  double worth;
};
std::optional<Valued> landmark_offer(Part& part, Index vertex, std::vector<Index> candidates,
                                     std::span<const Index> others);

}  // namespace sg::prune
