#include "lib/order/separator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "lib/order/metis.h"
#include "lib/order/vertex_cut.h"

namespace sg::order {
namespace {
// Scalar dimensions of what a separation makes of a piece.
struct Sizes {
  std::array<std::int64_t, 2> side{};    // inner vertices of the sides
  std::array<std::int64_t, 2> around{};  // what is around them, the separator's part among it
  std::int64_t separator = 0;
  std::int64_t outer = 0;

  std::int64_t inner() const { return side[0] + side[1] + separator; }
};

Sizes sizes(const Piece& piece, const Separation& side) {
  Sizes result;
  std::vector<char> met(piece.outer.size(), 0);  // bits: by which sides
  const auto count_around = [&](int sides, int weight) {
    for (const int k : {0, 1}) result.around[k] += (sides >> k & 1) != 0 ? weight : 0;
  };
  for (Index v = 0; v < piece.size(); ++v) {
    const int weight = piece.inner_weight[v];
    if (side[v] != in_separator) {
      result.side[side[v]] += weight;
      for (const Index b : piece.around[v]) met[b] = static_cast<char>(met[b] | 1 << side[v]);
      continue;
    }
    result.separator += weight;
    int sides = 0;
    for (const Index u : piece.inside[v]) sides |= 1 << side[u];
    count_around(sides, weight);
  }
  for (std::size_t b = 0; b < met.size(); ++b) count_around(met[b], piece.outer_weight[b]);
  result.outer =
      std::accumulate(piece.outer_weight.begin(), piece.outer_weight.end(), std::int64_t{0});
  return result;
}

// ((s + b)^3 - b^3) / 3
double clique_cost(double s, double b) {
  return s * (s * s + 3 * s * b + 3 * b * b) / 3;
}

// How separators grow: s = c w^gamma. Between the plane's 1/2 and the space's 2/3.
constexpr double growth = 0.6;

// What a piece of w scalars with b around it will cost.
double foretold(double w, double b, double c) {
  constexpr double least = 10;  // scalars of a piece that nobody parts
  double cost = 0;
  double pieces = 1;
  for (; w > least; pieces *= 2) {
    const double s = std::min(w, c * std::pow(w, growth));
    cost += pieces * clique_cost(s, b);
    w = (w - s) / 2;
    b = b / 2 + s;
  }
  return cost + pieces * clique_cost(w, b);
}

struct Candidate {
  Separation side;
  Sizes sizes;
  double price = std::numeric_limits<double>::infinity();  // where there are no two sides
};

double price(const Sizes& sizes, double c) {
  if (sizes.side[0] == 0 || sizes.side[1] == 0) return std::numeric_limits<double>::infinity();
  double cost = clique_cost(static_cast<double>(sizes.separator), static_cast<double>(sizes.outer));
  for (const int k : {0, 1}) {
    cost += foretold(static_cast<double>(sizes.side[k]), static_cast<double>(sizes.around[k]), c);
  }
  return cost;
}

Candidate candidate(const Piece& piece, Separation side, double c) {
  Candidate result{std::move(side), {}, 0};
  result.sizes = sizes(piece, result.side);
  result.price = price(result.sizes, c);
  return result;
}

// How much of each side a band may take in: some times the separator, and no side shall outgrow its share of the piece.
std::array<std::int64_t, 2> room(const Sizes& sizes) {
  constexpr double largest_share = 0.8;
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

void improve(const Piece& piece, double c, Candidate& best) {
  constexpr int rounds = 2;
  for (int round = 0; round < rounds; ++round) {
    auto [first, second] = minimum_separations(piece, best.side, room(best.sizes));
    Candidate a = candidate(piece, std::move(first), c);
    Candidate b = candidate(piece, std::move(second), c);
    Candidate& better = a.price <= b.price ? a : b;
    if (better.price >= best.price) return;
    best = std::move(better);
  }
}

// How many candidates a piece is worth: the more, the more each of its edges will cost.
int worthwhile(const Piece& piece, double price) {
  const auto entries = static_cast<double>(piece.inside.items.size() + piece.around.items.size());
  return static_cast<int>(std::clamp(std::log10(price / entries) - 2.5, 1.0, 4.0));
}

}  // namespace

Separation separation(const Piece& piece, std::uint64_t seed) {
  Candidate best;
  std::optional<double> c;  // of the first, so that all are measured alike
  int enough = 4;           // as long as none has two sides
  for (int k = 0; k < enough; ++k) {
    Separation side = metis_separation(piece, seed + static_cast<std::uint64_t>(k));
    const Sizes found = sizes(piece, side);
    if (!c) {
      c = static_cast<double>(found.separator) /
          std::pow(static_cast<double>(found.inner()), growth);
    }
    Candidate next{std::move(side), found, price(found, *c)};
    if (!std::isfinite(next.price)) continue;
    improve(piece, *c, next);
    if (next.price < best.price) best = std::move(next);
    enough = worthwhile(piece, best.price);
  }
  return best.side;
}

}  // namespace sg::order
