#include "lib/order/separator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "lib/order/levels.h"
#include "lib/order/metis.h"
#include "lib/order/price.h"
#include "lib/order/refine.h"
#include "lib/order/vertex_cut.h"

namespace sg::order {
namespace {

struct Candidate {
  Separation side;
  double price = std::numeric_limits<double>::infinity();
};

// How much of each side a band may take in: some times the separator, and no side shall outgrow its share of the piece.
std::array<std::int64_t, 2> room(const Sizes& sizes) {
  constexpr double separators = 12;
  std::array<std::int64_t, 2> result{};
  for (const int k : {0, 1}) {
    const double share = largest_share * static_cast<double>(sizes.inner()) -
                         static_cast<double>(sizes.side[1 - k] + sizes.separator);
    const double most = std::min({share, separators * static_cast<double>(sizes.separator),
                                  0.9 * static_cast<double>(sizes.side[k])});
    result[k] = static_cast<std::int64_t>(std::max(most, 0.0));
  }
  return result;
}

// The cheaper of the minimum separators nearby, if it is cheaper.
void improve(const Piece& piece, const Prices& prices, Candidate& best) {
  auto [first, second] = minimum_separations(piece, best.side, room(sizes(piece, best.side)));
  const double a = price(prices, sizes(piece, first)), b = price(prices, sizes(piece, second));
  if (std::min(a, b) >= best.price) return;
  best = a <= b ? Candidate{std::move(first), a} : Candidate{std::move(second), b};
}

// How many tries a piece is worth: the more, the more each of its edges will cost.
int worthwhile(const Piece& piece, double price) {
  const double an_entry = price / static_cast<double>(piece.entries());
  return static_cast<int>(std::clamp(std::log10(an_entry) - 4.2, 1.0, 3.0));
}

}  // namespace

Separation separation(const Piece& piece, std::uint64_t seed) {
  constexpr int passes = 2, patience = 40;
  constexpr Index large = 10'000;
  Candidate best;
  std::optional<Prices> by;  // of the first, so that all are measured alike
  const auto try_one = [&](Separation&& side) {
    if (side.empty()) return;
    Candidate next{std::move(side), 0};
    if (!by) by = prices(piece, static_cast<double>(sizes(piece, next.side).separator));
    next.price = refine(piece, *by, passes, patience, next.side);
    if (next.price < best.price) best = std::move(next);
  };
  int enough = 4;  // as long as none has two sides
  for (int k = 0; k < enough; ++k) {
    try_one(metis_separation(piece, seed + static_cast<std::uint64_t>(k)));
    if (k == 0) {
      const double by_metis = best.price;
      try_one(level_separation(piece, *by));
      if (best.price < by_metis && piece.size() > large) break;  // a grid: METIS seldom does better
    }
    if (std::isfinite(best.price)) enough = worthwhile(piece, best.price);
  }
  if (!best.side.empty()) improve(piece, *by, best);
  return std::move(best.side);
}

}  // namespace sg::order
