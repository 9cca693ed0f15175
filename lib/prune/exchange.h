// What a budget of EC could have better: exchange of what tells least for what it costs, and what is free.
//
// A greedy selection is stuck with moves that later ones made worthless, and with an order that suited them. Time and
// again, of all that could go,
//     (what would be lost by it) / (EC without it, less + edge_cost times its edges)
// is computed, the least go until a share of EC is free, and the greedy goes on up to the budget in an order of its own
// (Ropke and Pisinger, Adaptive large neighborhood search, 2006, call that ruin and recreate). What comes of it stays if more
// is achieved; if not, the next share is smaller. Losses are estimated and prices are those of a row alone
// (row_price.h): both serve the choice only.
//
// What a selection could have for nothing is found at its end: candidates whose variables stand together in one clique.
// To take them at every renewal binds later orders, and costs more than it gives.
#pragma once

#include "lib/prune/evidence.h"
#include "lib/prune/move.h"

namespace sg::prune {

// These moves, and perhaps drops and moves after them, up to options.ec, within which the moves are. A start alone stays.
std::vector<Move> exchanged(const Choice& choice, const Evidence& evidence,
                            const EcGreedyOptions& options, std::vector<Move> moves);

// A last move after these: every candidate that is free in the order of its own that their selection has; increase 0.
// Nothing where there is none, or where EC, scored again, exceeds both what it was and options.ec: a heuristic's order of
// more edges is another one.
std::optional<Move> free_edges(const Choice& choice, const Evidence& evidence,
                               std::span<const Move> moves, const EcGreedyOptions& options);

}  // namespace sg::prune
