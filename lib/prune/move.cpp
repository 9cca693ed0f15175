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
  std::size_t low = least, high = moves.size();  // the last that fits is in [low, high]
  while (low < high) {
    const std::size_t middle = (low + high + 1) / 2;
    if (ec_after(choice, moves.first(middle), options) <= ec) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  return low;
}

}  // namespace sg::prune
