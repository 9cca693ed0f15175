#include "lib/order/levels.h"

#include <algorithm>
#include <limits>

#include "lib/order/breadth_first.h"

namespace sg::order {
namespace {

struct Search {
  std::vector<Index> sequence;  // as they are met
  std::vector<Index> distance;  // of every vertex
};

Search breadth_first(const Piece& piece, Index root) {
  Search result{{}, std::vector<Index>(static_cast<std::size_t>(piece.size()), not_met)};
  order::breadth_first(piece.inside, root, 0, result.distance, result.sequence);
  return result;
}

// Of what is farthest from where the search began, one with the fewest neighbours.
Index far_end(const Piece& piece, const Search& search) {
  const Index farthest = search.distance[search.sequence.back()];
  Index best = search.sequence.back();
  for (auto v = search.sequence.rbegin();
       v != search.sequence.rend() && search.distance[*v] == farthest; ++v) {
    if (piece.inside[*v].size() < piece.inside[best].size()) best = *v;
  }
  return best;
}

// What has been met is side 0, but for the separator: what of it has neighbours yet to come, which are side 1.
struct Sweep {
  const Piece& piece;
  Tally tally;
  std::vector<Index> waits;  // of a vertex: neighbours yet to come
  std::vector<char> met;
};

Sweep sweep(const Piece& piece) {
  const auto size = static_cast<std::size_t>(piece.size());
  Sweep result{piece, tally(piece, Separation(size, 1)), {}, std::vector<char>(size, false)};
  for (Index v = 0; v < piece.size(); ++v)
    result.waits.push_back(static_cast<Index>(piece.inside[v].size()));
  return result;
}

void meet(Sweep& s, Index v) {
  const auto leave_separator = [&](Index u) { change(s.piece, u, in_separator, 0, s.tally); };
  s.met[v] = true;
  change(s.piece, v, 1, in_separator, s.tally);
  if (s.waits[v] == 0) leave_separator(v);
  for (const Index u : s.piece.inside[v]) {
    if (--s.waits[u] == 0 && s.met[u]) leave_separator(u);
  }
}

struct Cut {
  double price = std::numeric_limits<double>::infinity();
  const std::vector<Index>* sequence = nullptr;
  std::size_t length = 0;  // of its cheapest prefix
};

void try_prefixes(const Sweep& start, const Prices& prices, const std::vector<Index>& sequence,
                  Cut& best) {
  Sweep s = start;
  for (std::size_t k = 0; k < sequence.size(); ++k) {
    meet(s, sequence[k]);
    const double cost = price(prices, s.tally.sizes);
    if (cost < best.price) best = {cost, &sequence, k + 1};
  }
}

Separation separation(const Piece& piece, const Cut& cut) {
  Separation side(static_cast<std::size_t>(piece.size()), 1);
  for (std::size_t k = 0; k < cut.length; ++k) side[(*cut.sequence)[k]] = 0;
  for (std::size_t k = 0; k < cut.length; ++k) {
    const Index v = (*cut.sequence)[k];
    const auto others = piece.inside[v];
    if (std::ranges::any_of(others, [&](Index u) { return side[u] == 1; })) side[v] = in_separator;
  }
  return side;
}

}  // namespace

Separation level_separation(const Piece& piece, const Prices& prices) {
  Search from = breadth_first(piece, 0);
  Search to = breadth_first(piece, far_end(piece, from));
  from = breadth_first(piece, far_end(piece, to));
  // By the difference of the distances from both ends, ties as the first search met them.
  std::vector<Index> between = from.sequence;
  std::ranges::stable_sort(between, {}, [&](Index v) { return from.distance[v] - to.distance[v]; });
  const Sweep start = sweep(piece);
  Cut best;
  for (const std::vector<Index>* sequence : {&from.sequence, &to.sequence, &between}) {
    try_prefixes(start, prices, *sequence, best);
  }
  return best.sequence ? separation(piece, best) : Separation{};
}

}  // namespace sg::order
