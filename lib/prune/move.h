// A greedy selection's moves, and what of them a budget allows.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "lib/elim/score.h"
#include "lib/prune/selection.h"

namespace sg::prune {

// What is maximized: by how much the sum of the positions' variances falls; the same after the rigid motion that fits the
// whole best; or by how much the log determinant of the evidence's information grows.
enum class GainKind : std::uint8_t { trace, aligned, log_det };

struct Move {
  enum class Kind : std::uint8_t { start, edge, landmark, drop, free } kind;
  std::vector<Index> edges;  // candidates that come in by it; of a drop, that go out
  double gain;               // exact, if told; of a drop, below zero
  elim::Wide increase;       // of EC, under the order as it was; 0 of a drop
  elim::Wide ec;             // after it, under that order; of a drop, in an order of its own
  double sigma;              // after it: mean standard deviation of a pose's position
  Index kept;                // candidates by then
};
std::string_view name(Move::Kind kind);

struct EcGreedyOptions {
  GainKind gain = GainKind::trace;
  std::uint64_t seed = 1;  // of the gains' random vectors
  // An elimination order of a part of the graph.
  std::function<graph::Order(const graph::GraphPattern&)> order;
  // Whether the moves' gains and sigmas are wanted; else they may be 0. To settle them takes longer than the choice.
  bool told = false;
  // Told how many candidates are kept, and asked whether to go on; may be empty.
  std::function<bool(Index kept)> go_on;

  std::optional<elim::Wide> start_ec;  // the start's EC is no more than this, if it can

  // It ends when one of these is reached, or nothing is left to come in.
  std::optional<elim::Wide> ec;  // EC is above, in an order of its own
  std::optional<double> sigma;
  std::optional<Index> kept;  // no more than these
};

// What stays after these moves: of every candidate, side by side with them.
std::vector<bool> kept_by(const std::vector<Index>& candidates, std::span<const Move> moves);

// EC of these moves' selection in an order of its own.
elim::Wide ec_after(const Choice& choice, std::span<const Move> moves,
                    const EcGreedyOptions& options);

// How many of the first moves a budget of EC allows, each selection in an order of its own (EC as it will be scored); at
// least `least`, which have to fit.
std::size_t moves_within(const Choice& choice, std::span<const Move> moves, elim::Wide ec,
                         const EcGreedyOptions& options, std::size_t least = 1);

}  // namespace sg::prune
