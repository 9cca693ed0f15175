// Keep what tells most of where the poses are for what it costs: greedy by accuracy per elimination complexity.
//
// Start from a sparse selection (selection.h) that determines all poses. Then, in a fixed elimination order of what is
// selected, make the move of largest
//     gain / (increase of EC + edge_cost times its edges).
// Moves are an edge, and a landmark that is not in with as many of its observations as determine it. The increase is
// exact under the order (filled_graph.h); the gain is an estimate in choosing and exact in what is told
// (information_gain.h). Moves wait in a heap under their last value, which is computed anew before it is believed. When EC
// has grown by a quarter the order is renewed.
//
// What a selection could have for nothing is found at its end: candidates whose variables stand together in one clique.
// To take them at every renewal binds later orders, and costs more than it gives.
//
// Nothing that is determined is ever left undetermined: poses are from the start on, and a landmark comes in with
// observations that determine it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "lib/elim/score.h"
#include "lib/prune/evidence.h"
#include "lib/prune/selection.h"

namespace sg::prune {

// What is maximized: by how much the sum of the positions' variances falls, or the log determinant of the evidence's
// information grows.
enum class GainKind : std::uint8_t { trace, log_det };

struct Move {
  enum class Kind : std::uint8_t { start, edge, landmark, free } kind;
  std::vector<Index> edges;  // candidates that come in by it
  double gain;               // exact
  elim::Wide increase;       // of EC, under the order as it was
  elim::Wide ec;             // after it, under that order
  double sigma;              // after it: mean standard deviation of a pose's position
  Index kept;                // candidates by then
};
std::string_view name(Move::Kind kind);

struct EcGreedyOptions {
  GainKind gain = GainKind::trace;
  std::uint64_t seed = 1;  // of the gains' random vectors
  // An elimination order of a part of the graph.
  std::function<graph::Order(const graph::GraphPattern&)> order;
  // Told how many candidates are kept, and asked whether to go on; may be empty.
  std::function<bool(Index kept)> go_on;

  std::optional<elim::Wide> start_ec;  // the start's EC is no more than this, if it can

  // It ends when one of these is reached, or nothing is left to come in.
  std::optional<elim::Wide> ec;  // EC is above, in an order of its own
  std::optional<double> sigma;
  std::optional<Index> kept;  // no more than these
};

constexpr Index start_rate = 16;
constexpr elim::Wide edge_cost = 100;

// The moves, in order; the first is the start, with those candidates that are in it and the rest of the graph. None where
// all of the graph leaves something undetermined.
std::vector<Move> ecgreedy(const Choice& choice, const Evidence& evidence,
                           const EcGreedyOptions& options);

// A last move after these: every candidate that is free in the order of its own that their selection has; increase 0.
// Nothing where there is none, or where EC, scored again, exceeds both what it was and options.ec: a heuristic's order of
// more edges is another one.
std::optional<Move> free_edges(const Choice& choice, const Evidence& evidence,
                               std::span<const Move> moves, const EcGreedyOptions& options);

// What stays after these moves: of every candidate, side by side with them.
std::vector<bool> kept_by(const std::vector<Index>& candidates, std::span<const Move> moves);

// How many of the first moves a budget of EC allows, each selection in an order of its own (EC as it will be scored); at
// least one, the start.
std::size_t moves_within(const Choice& choice, std::span<const Move> moves, elim::Wide ec,
                         const EcGreedyOptions& options);
// The mean sigma of the whole graph; nothing where that leaves something undetermined.
std::optional<double> whole_sigma(const Choice& choice, const Evidence& evidence,
                                  const EcGreedyOptions& options);
// EC of these moves' selection in an order of its own.
elim::Wide ec_after(const Choice& choice, std::span<const Move> moves,
                    const EcGreedyOptions& options);

}  // namespace sg::prune
