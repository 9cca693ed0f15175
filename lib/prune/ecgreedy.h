// Keep what tells most of where the poses are for what it costs: greedy by accuracy per elimination complexity.
//
// Start from a sparse selection (selection.h) that determines all poses. Then, in a fixed elimination order of what is
// selected, make the move of largest
//     gain / (increase of EC + edge_cost times its edges).
// Moves are an edge, and a landmark that is not in with as many of its observations as determine it. The increase is
// exact under the order (filled_graph.h); the gain is an estimate in choosing and exact in what is told, if that is wanted
// (information_gain.h, settle.h), both by a factor in an order of its own (part.h). Moves wait in a heap under their last
// value, which is computed anew before it is believed. When EC has grown by a quarter the order is renewed.
//
// What a selection could have for nothing is found at its end: candidates whose variables stand together in one clique.
// To take them at every renewal binds later orders, and costs more than it gives.
//
// Nothing that is determined is ever left undetermined: poses are from the start on, and a landmark comes in with
// observations that determine it.
#pragma once

#include "lib/prune/evidence.h"
#include "lib/prune/move.h"

namespace sg::prune {

constexpr Index start_rate = 16;

// The moves, in order; the first is the start, with those candidates that are in it and the rest of the graph. None where
// all of the graph leaves something undetermined.
std::vector<Move> ecgreedy(const Choice& choice, const Evidence& evidence,
                           const EcGreedyOptions& options);

// Goes on from the selection that these moves have left, the last of which is yet to be told what it gained and its sigma:
// beside `before`, what was achieved without it. None where something is undetermined.
std::vector<Move> ecgreedy_from(const Choice& choice, const Evidence& evidence,
                                const EcGreedyOptions& options, std::vector<Move> moves,
                                double before);

}  // namespace sg::prune
