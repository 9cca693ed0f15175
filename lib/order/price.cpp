#include "lib/order/price.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sg::order {
namespace {

// How separators grow: s = c w^gamma. Between the plane's 1/2 and the space's 2/3.
constexpr double growth = 0.6;
constexpr double least = 10;  // scalars of a piece that nobody parts
constexpr int table_size = 32;

double clique_cost(double s, double b) {
  return s * (s * s / 3 + s * b + b * b);
}

// Of a piece of w scalars, in powers of what is around it.
std::array<double, 3> foretold(double w, double c) {
  std::array<double, 3> sum{};
  double pieces = 1;
  double share = 1, more = 0;  // around a piece at this depth: share b + more
  const auto add = [&](double s) {
    sum[0] += pieces * clique_cost(s, more);
    sum[1] += pieces * s * share * (s + 2 * more);
    sum[2] += pieces * s * share * share;
  };
  for (; w > least; pieces *= 2) {
    const double s = std::min(w, c * std::pow(w, growth));
    add(s);
    w = (w - s) / 2;
    share /= 2;
    more = more / 2 + s;
  }
  add(w);
  return sum;
}

double side_price(const Prices& prices, double w, double b) {
  const double at = w / prices.step;
  const auto k = std::min(static_cast<std::size_t>(at), prices.foretold.size() - 2);
  const double t = at - static_cast<double>(k);
  const auto value = [&](std::size_t entry) {
    const std::array<double, 3>& f = prices.foretold[entry];
    return f[0] + b * (f[1] + b * f[2]);
  };
  return (1 - t) * value(k) + t * value(k + 1);
}

}  // namespace

Tally tally(const Piece& piece, const Separation& side) {
  Tally result;
  for (std::vector<Index>& meets : result.meets) meets.assign(piece.outer_weight.size(), 0);
  for (Index v = 0; v < piece.size(); ++v) {
    result.sizes.separator += piece.inner_weight[v];
    if (side[v] != in_separator) change(piece, v, in_separator, side[v], result);
  }
  return result;
}

void change(const Piece& piece, Index v, char from, char to, Tally& tally) {
  Sizes& sizes = tally.sizes;
  const int weight = piece.inner_weight[v];
  (from == in_separator ? sizes.separator : sizes.side[from]) -= weight;
  (to == in_separator ? sizes.separator : sizes.side[to]) += weight;
  for (const Index b : piece.around[v]) {
    if (from != in_separator && --tally.meets[from][b] == 0) {
      sizes.outer[from] -= piece.outer_weight[b];
    }
    if (to != in_separator && tally.meets[to][b]++ == 0) sizes.outer[to] += piece.outer_weight[b];
  }
}

Sizes sizes(const Piece& piece, const Separation& side) {
  return tally(piece, side).sizes;
}

Prices prices(const Piece& piece, double separator) {
  const auto sum = [](const std::vector<int>& weights) {
    return static_cast<double>(std::accumulate(weights.begin(), weights.end(), std::int64_t{0}));
  };
  const double inner = sum(piece.inner_weight);
  const double c = separator / std::pow(inner, growth);
  Prices result{sum(piece.outer_weight), inner / table_size, {}};
  for (int k = 0; k <= table_size; ++k) result.foretold.push_back(foretold(k * result.step, c));
  return result;
}

double price(const Prices& prices, const Sizes& sizes) {
  const auto larger = static_cast<double>(std::max(sizes.side[0], sizes.side[1]));
  if (std::min(sizes.side[0], sizes.side[1]) == 0 ||
      larger > largest_share * static_cast<double>(sizes.inner())) {
    return std::numeric_limits<double>::infinity();
  }
  const auto separator = static_cast<double>(sizes.separator);
  double cost = clique_cost(separator, prices.outer);
  for (const int k : {0, 1}) {
    cost += side_price(prices, static_cast<double>(sizes.side[k]),
                       separator + static_cast<double>(sizes.outer[k]));
  }
  return cost;
}

}  // namespace sg::order
