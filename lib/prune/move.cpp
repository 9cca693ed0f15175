#include "lib/prune/move.h"

#include <array>

namespace sg::prune {

std::string_view name(Move::Kind kind) {
  constexpr std::array names{"start", "edge", "landmark", "drop", "free"};
  return names[static_cast<std::size_t>(kind)];
}

std::vector<bool> kept_by(const std::vector<Index>& candidates, std::span<const Move> moves) {
  std::vector<bool> in;  // edges
  for (const Move& move : moves) {
    for (const Index e : move.edges) {
      if (e >= static_cast<Index>(in.size())) in.resize(e + 1, false);
      in[e] = move.kind != Move::Kind::drop;
    }
  }
  std::vector<bool> kept;
  kept.reserve(candidates.size());
  for (const Index e : candidates) kept.push_back(e < static_cast<Index>(in.size()) && in[e]);
  return kept;
}

elim::Wide ec_after(const Choice& choice, std::span<const Move> moves,
                    const EcGreedyOptions& options) {
  const Selection in = selection(choice, kept_by(choice.candidates, moves));
  const graph::GraphPattern part = graph::graph_pattern(choice.graph, in.vertex, in.edge);
  return elim::elimination_complexity(part.pattern, options.order(part));
}

std::size_t moves_within(const Choice& choice, std::span<const Move> moves, elim::Wide ec,
                         const EcGreedyOptions& options, std::size_t least) {
  // Asking takes an order, and the last that fit are most often near the end: back from there by ever larger steps, then halves.
  std::size_t fit = least, over = moves.size() + 1;
  std::size_t step = 1;
  while (over - fit > 1) {
    const std::size_t asked =
        step > 0 ? std::max(fit + 1, over - std::min(over, step)) : fit + (over - fit) / 2;
    if (ec_after(choice, moves.first(asked), options) <= ec) {
      fit = asked;
      step = 0;
    } else {
      over = asked;
      step *= 2;
    }
  }
  return fit;
}

}  // namespace sg::prune
