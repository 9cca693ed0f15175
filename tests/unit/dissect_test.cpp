#include "lib/order/dissect.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "lib/order/fill_graph.h"
#include "lib/order/levels.h"
#include "lib/order/order.h"
#include "lib/order/price.h"
#include "lib/order/refine.h"
#include "lib/order/separator.h"
#include "lib/order/vertex_cut.h"
#include "lib/order/wmf.h"
#include "tests/unit/common.h"

using namespace sg::test;

namespace {

using sg::Index;
using sg::graph::Adjacency;
using sg::graph::Order;
using sg::graph::Pattern;
using sg::order::Piece;
using sg::order::Separation;

// A grid in the plane with some of its edges left out, and a few far ones.
Pattern odd_grid(Random& random, Index side) {
  std::vector<int> dim(static_cast<std::size_t>(side) * side);
  for (int& d : dim) d = draw(random, 1, 6);
  std::vector<std::vector<Index>> rows;
  const auto cell = [&](Index x, Index y) { return y * side + x; };
  for (Index y = 0; y < side; ++y) {
    for (Index x = 0; x < side; ++x) {
      if (x + 1 < side && draw(random, 0, 9) > 0) rows.push_back({cell(x, y), cell(x + 1, y)});
      if (y + 1 < side && draw(random, 0, 9) > 0) rows.push_back({cell(x, y), cell(x, y + 1)});
    }
  }
  for (Index k = 0; k < side / 2; ++k) {
    const std::vector<Index> ends = shuffled(random, side * side);
    rows.push_back({ends[0], ends[1], ends[2]});
  }
  return make_pattern(std::move(dim), rows);
}

Piece piece_of(const Adjacency& graph, const std::vector<int>& dim, std::vector<Index> inner) {
  std::vector<Index> number(dim.size(), 0);
  Piece result = sg::order::piece(graph, dim, std::move(inner), number);
  CHECK(number == std::vector<Index>(dim.size(), 0));
  return result;
}

std::vector<Index> first(Index n) {
  std::vector<Index> all(n);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

bool separates(const Piece& piece, const Separation& side) {
  for (Index v = 0; v < piece.size(); ++v) {
    for (const Index u : piece.inside[v]) {
      if (side[v] + side[u] == 1) return false;
    }
  }
  return true;
}

int separator_weight(const Piece& piece, const Separation& side) {
  int sum = 0;
  for (Index v = 0; v < piece.size(); ++v) {
    if (side[v] == sg::order::in_separator) sum += piece.inner_weight[v];
  }
  return sum;
}

// Any separation: what is left of a side that has a neighbour on the other is taken into the separator.
Separation some_separation(Random& random, const Piece& piece) {
  Separation side(piece.size());
  for (char& s : side) s = static_cast<char>(draw(random, 0, 1));
  for (Index v = 0; v < piece.size(); ++v) {
    for (const Index u : piece.inside[v]) {
      if (side[v] + side[u] == 1) side[v] = sg::order::in_separator;
    }
  }
  return side;
}

// By the definition of Sizes, vertex by vertex.
sg::order::Sizes literal_sizes(const Piece& piece, const Separation& side) {
  sg::order::Sizes result;
  std::array<std::set<Index>, 2> outer;
  for (Index v = 0; v < piece.size(); ++v) {
    if (side[v] == sg::order::in_separator) {
      result.separator += piece.inner_weight[v];
      continue;
    }
    result.side[side[v]] += piece.inner_weight[v];
    outer[side[v]].insert(piece.around[v].begin(), piece.around[v].end());
  }
  for (const int k : {0, 1}) {
    for (const Index b : outer[k]) result.outer[k] += piece.outer_weight[b];
  }
  return result;
}

// ((s + b)^3 - b^3) / 3
double clique_cost(double s, double b) {
  return (std::pow(s + b, 3) - std::pow(b, 3)) / 3;
}

// What price.h foretells of w scalars with b around them, halved again and again.
double literal_foretold(double w, double b, double c) {
  double cost = 0;
  double pieces = 1;
  for (; w > 10; pieces *= 2) {
    const double s = std::min(w, c * std::pow(w, 0.6));
    cost += pieces * clique_cost(s, b);
    w = (w - s) / 2;
    b = b / 2 + s;
  }
  return cost + pieces * clique_cost(w, b);
}

// The least weight of any separator that leaves these on their sides: all of them tried.
int least_separator(const Piece& piece, Separation side, const std::vector<Index>& free) {
  int least = 1 << 20;
  int ways = 1;
  for (std::size_t k = 0; k < free.size(); ++k) ways *= 3;
  for (int way = 0; way < ways; ++way) {
    for (int k = 0, rest = way; k < static_cast<int>(free.size()); ++k, rest /= 3) {
      side[free[k]] = static_cast<char>(rest % 3);
    }
    if (separates(piece, side)) least = std::min(least, separator_weight(piece, side));
  }
  return least;
}

}  // namespace

TEST_CASE("a piece has its inner edges and what is around it", "[dissect]") {
  const Pattern pattern = make_pattern({1, 2, 3, 4, 5}, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {1, 4}});
  const Piece piece = piece_of(sg::graph::adjacency(pattern), pattern.dim, {1, 2});
  CHECK(piece.inside.items == std::vector<Index>{1, 0});
  CHECK(piece.outer == std::vector<Index>{0, 4, 3});
  CHECK(piece.outer_weight == std::vector<int>{1, 5, 4});
  CHECK(piece.around.items == std::vector<Index>{0, 1, 2});
  CHECK(piece.around.begin == std::vector<Index>{0, 2, 3});
}

TEST_CASE("a minimum separator in a band is one of all that there are", "[dissect]") {
  Random random(1);
  int smaller = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Index n = draw(random, 4, 9);
    const Pattern pattern = odd_pattern(random, n, 4);
    const Adjacency graph = sg::graph::adjacency(pattern);
    const Piece piece = piece_of(graph, pattern.dim, first(n));
    Separation side = some_separation(random, piece);
    REQUIRE(separates(piece, side));
    const std::array<std::int64_t, 2> room{draw(random, 0, 8), draw(random, 0, 8)};
    const auto found = sg::order::minimum_separations(piece, side, room);
    // What neither moved is either beyond the band or might as well be: of the others all ways are tried.
    for (const int k : {0, 1}) {
      REQUIRE(separates(piece, found[k]));
      REQUIRE(separator_weight(piece, found[k]) <= separator_weight(piece, side));
    }
    REQUIRE(separator_weight(piece, found[0]) == separator_weight(piece, found[1]));
    std::vector<Index> moved;
    for (Index v = 0; v < n; ++v) {
      if (side[v] == sg::order::in_separator || found[0][v] != side[v] || found[1][v] != side[v]) {
        moved.push_back(v);
      }
    }
    REQUIRE(separator_weight(piece, found[0]) == least_separator(piece, side, moved));
    smaller += separator_weight(piece, found[0]) < separator_weight(piece, side);
  }
  CHECK(smaller > 30);
}

TEST_CASE("what a separation makes of a piece is counted, and refined while it is", "[dissect]") {
  Random random(7);
  int cheaper = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Pattern pattern = odd_grid(random, draw(random, 5, 12));
    const Index n = pattern.variables();
    const Adjacency graph = sg::graph::adjacency(pattern);
    const Piece piece = piece_of(graph, pattern.dim, first(n - draw(random, 0, n / 3)));
    Separation side = some_separation(random, piece);
    const auto agree = [&] {
      const sg::order::Sizes a = sg::order::sizes(piece, side), b = literal_sizes(piece, side);
      return a.side == b.side && a.outer == b.outer && a.separator == b.separator;
    };
    REQUIRE(agree());
    const auto prices = sg::order::prices(piece, draw(random, 10, 60));
    const double before = sg::order::price(prices, literal_sizes(piece, side));
    const double after =
        sg::order::refine(piece, prices, draw(random, 1, 4), draw(random, 1, 40), side);
    REQUIRE(separates(piece, side));
    REQUIRE(after <= before);
    REQUIRE(after == sg::order::price(prices, literal_sizes(piece, side)));
    cheaper += after < before;
  }
  CHECK(cheaper > 100);
}

TEST_CASE("a move that makes a separator cheaper is found", "[dissect]") {
  // A path whose separator is two vertices wide: one of them goes to its side.
  const Pattern path = make_pattern({3, 3, 3, 3, 3, 3}, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}});
  const Piece piece = piece_of(sg::graph::adjacency(path), path.dim, first(6));
  Separation side{0, 0, 2, 2, 1, 1};
  sg::order::refine(piece, sg::order::prices(piece, 3), 1, 1, side);
  CHECK(std::count(side.begin(), side.end(), sg::order::in_separator) == 1);
  CHECK(separates(piece, side));
}

TEST_CASE("the price of a separation is what its formula says", "[dissect]") {
  Random random(8);
  const Pattern pattern = odd_grid(random, 16);
  const Piece piece = piece_of(sg::graph::adjacency(pattern), pattern.dim, first(200));
  double inner = 0, outer = 0;
  for (const int w : piece.inner_weight) inner += w;
  for (const int w : piece.outer_weight) outer += w;
  const double c = 50 / std::pow(inner, 0.6);
  const auto prices = sg::order::prices(piece, 50);
  for (std::size_t k = 1; k < prices.foretold.size(); ++k) {
    for (const double b : {0.0, 7.0, 300.0}) {
      const auto& f = prices.foretold[k];
      const double w = static_cast<double>(k) * prices.step;
      CHECK(f[0] + b * f[1] + b * b * f[2] == Approx(literal_foretold(w, b, c)));
    }
  }
  sg::order::Sizes sizes;
  sizes.side = {static_cast<std::int64_t>(0.4 * inner), static_cast<std::int64_t>(0.5 * inner)};
  sizes.separator = static_cast<std::int64_t>(inner) - sizes.side[0] - sizes.side[1];
  sizes.outer = {20, 30};
  const auto separator = static_cast<double>(sizes.separator);
  double expected = clique_cost(separator, outer);
  for (const int k : {0, 1}) {
    expected += literal_foretold(static_cast<double>(sizes.side[k]),
                                 separator + static_cast<double>(sizes.outer[k]), c);
  }
  CHECK(sg::order::price(prices, sizes) == Approx(expected).epsilon(0.02));  // between entries
  sizes.side = {0, static_cast<std::int64_t>(inner) - sizes.separator};
  CHECK(std::isinf(sg::order::price(prices, sizes)));
}

// Distances from a vertex, by relaxing every edge until nothing changes.
std::vector<Index> literal_distances(const Piece& piece, Index root) {
  std::vector<Index> distance(piece.size(), piece.size());
  distance[root] = 0;
  for (bool changed = true; std::exchange(changed, false);) {
    for (Index v = 0; v < piece.size(); ++v) {
      for (const Index u : piece.inside[v]) {
        if (distance[u] <= distance[v] + 1) continue;
        distance[u] = distance[v] + 1;
        changed = true;
      }
    }
  }
  return distance;
}

// The cheapest separation of a level structure's levels: what is nearer is side 0.
double cheapest_level(const Piece& piece, const std::vector<Index>& distance,
                      const sg::order::Prices& prices) {
  double best = std::numeric_limits<double>::infinity();
  for (Index level = 0; level < std::ranges::max(distance); ++level) {
    Separation side(piece.size());
    for (Index v = 0; v < piece.size(); ++v) {
      side[v] = distance[v] > level ? 1 : distance[v] < level ? 0 : sg::order::in_separator;
      const auto others = piece.inside[v];
      if (distance[v] == level &&
          std::ranges::none_of(others, [&](Index u) { return distance[u] > level; })) {
        side[v] = 0;
      }
    }
    best = std::min(best, sg::order::price(prices, literal_sizes(piece, side)));
  }
  return best;
}

TEST_CASE("a separator of levels parts the piece, for no more than any level from its ends",
          "[dissect]") {
  Random random(9);
  int parted = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Index width = draw(random, 2, 12);
    const Pattern pattern = odd_grid(random, width);
    const Adjacency graph = sg::graph::adjacency(pattern);
    const Piece all = piece_of(graph, pattern.dim, first(width * width - draw(random, 0, width)));
    const auto connected = sg::order::parts(all, Separation(all.size(), 0));
    const Piece piece = piece_of(graph, pattern.dim, {connected[0].begin(), connected[0].end()});
    const sg::order::Prices prices = sg::order::prices(piece, 10);
    const Separation side = sg::order::level_separation(piece, prices);
    if (side.empty()) continue;
    ++parted;
    REQUIRE(separates(piece, side));
    const double price = sg::order::price(prices, literal_sizes(piece, side));
    CHECK(std::isfinite(price));
    // An end: farthest from where the last search began, with the fewest neighbours there.
    const auto far_end = [&](const std::vector<Index>& distance) {
      const Index most = std::ranges::max(distance);
      std::size_t fewest = piece.size();
      for (Index v = 0; v < piece.size(); ++v) {
        if (distance[v] == most) fewest = std::min(fewest, piece.inside[v].size());
      }
      std::vector<Index> ends;
      for (Index v = 0; v < piece.size(); ++v) {
        if (distance[v] == most && piece.inside[v].size() == fewest) ends.push_back(v);
      }
      return ends;
    };
    // Several may be as far: it has taken one of them, twice.
    double dearest = 0;
    for (const Index to : far_end(literal_distances(piece, 0))) {
      for (const Index from : far_end(literal_distances(piece, to))) {
        for (const Index end : {to, from}) {
          dearest = std::max(dearest, cheapest_level(piece, literal_distances(piece, end), prices));
        }
      }
    }
    CHECK(price <= dearest * (1 + 1e-12));
    CHECK(sg::order::level_separation(piece, prices) == side);
  }
  CHECK(parted > 100);
}

TEST_CASE("the levels of a grid in space from its corner are its diagonal planes", "[dissect]") {
  constexpr Index n = 9;
  const auto cell = [](Index x, Index y, Index z) { return (z * n + y) * n + x; };
  std::vector<std::vector<Index>> rows;
  for (Index z = 0; z < n; ++z) {
    for (Index y = 0; y < n; ++y) {
      for (Index x = 0; x < n; ++x) {
        if (x + 1 < n) rows.push_back({cell(x, y, z), cell(x + 1, y, z)});
        if (y + 1 < n) rows.push_back({cell(x, y, z), cell(x, y + 1, z)});
        if (z + 1 < n) rows.push_back({cell(x, y, z), cell(x, y, z + 1)});
      }
    }
  }
  const Pattern grid = make_pattern(std::vector<int>(n * n * n, 1), rows);
  const Piece piece = piece_of(sg::graph::adjacency(grid), grid.dim, first(n * n * n));
  const Separation side = sg::order::level_separation(piece, sg::order::prices(piece, n * n));
  // x + y + z = 12, 3 (n - 1) / 2: 61 of 9 x 9 cells have room for z.
  CHECK(separator_weight(piece, side) == 61);
}

TEST_CASE("a separator parts a wide graph in two, the same each time", "[dissect]") {
  Random random(2);
  for (int trial = 0; trial < 10; ++trial) {
    const Pattern pattern = odd_grid(random, 20);
    const Piece piece = piece_of(sg::graph::adjacency(pattern), pattern.dim, first(400));
    const Separation side = sg::order::separation(piece, 1);
    REQUIRE(separates(piece, side));
    CHECK(std::count(side.begin(), side.end(), 0) > 40);
    CHECK(std::count(side.begin(), side.end(), 1) > 40);
    CHECK(side == sg::order::separation(piece, 1));
  }
}

TEST_CASE("a clique has no separator", "[dissect]") {
  std::vector<Index> all = first(50);
  const Pattern clique = make_pattern(std::vector<int>(50, 3), {all});
  CHECK(sg::order::separation(piece_of(sg::graph::adjacency(clique), clique.dim, all), 1).empty());
}

TEST_CASE("the fill graph of a part knows fills and degrees, outer variables being joined",
          "[dissect]") {
  Random random(3);
  for (int trial = 0; trial < 400; ++trial) {
    const Index n = draw(random, 2, 24), inner = draw(random, 1, n - 1);
    Pattern pattern = odd_pattern(random, n);
    std::vector<std::set<Index>> joined(n);
    const Adjacency whole = sg::graph::adjacency(pattern);
    Adjacency part;
    for (Index v = 0; v < n; ++v) {
      for (const Index u : whole[v]) {
        if (v < inner || u < inner) part.items.push_back(u);
        joined[v].insert(u);
      }
      for (Index u = inner; v >= inner && u < n; ++u) joined[v].insert(u);
      joined[v].erase(v);
      part.close();
    }
    auto graph = sg::order::fill_graph_of_part(part, pattern.dim, inner, 1'000'000);
    std::vector<bool> gone(n, false);
    for (;;) {
      std::vector<Index> alive;
      for (Index v = 0; v < inner; ++v) {
        if (!graph.variables.alive[v]) continue;
        alive.push_back(v);
        std::set<Index> around = joined[v];
        for (Index m = v; m >= 0; m = graph.variables.next[m]) around.erase(m);
        std::int64_t degree = 0, fill = 0;
        for (const Index a : around) {
          degree += pattern.dim[a];
          for (const Index b : around) {
            if (a < b && !joined[a].count(b)) fill += std::int64_t{pattern.dim[a]} * pattern.dim[b];
          }
        }
        REQUIRE(graph.degree[v] == degree);
        REQUIRE(graph.fill[v].fill == fill);
      }
      if (alive.empty()) break;
      const std::size_t done = graph.variables.order.size();
      sg::order::eliminate(graph, alive[draw(random, 0, static_cast<int>(alive.size()) - 1)]);
      for (std::size_t k = done; k < graph.variables.order.size(); ++k) {
        const Index v = graph.variables.order[k];
        for (const Index a : joined[v]) {
          joined[a].insert(joined[v].begin(), joined[v].end());
          joined[a].erase(a);
        }
        for (const Index a : joined[v]) joined[a].erase(v);
      }
    }
    REQUIRE(static_cast<Index>(graph.variables.order.size()) == inner);
  }
}

TEST_CASE("what pieces say they cost is what the order costs", "[dissect]") {
  Random random(4);
  for (int trial = 0; trial < 12; ++trial) {
    const Pattern pattern = odd_grid(random, draw(random, 15, 45));
    const Adjacency graph = sg::graph::adjacency(pattern);
    const Index n = pattern.variables();
    const auto found = sg::order::nested_dissection(graph, pattern.dim, n, 0);
    REQUIRE(sg::graph::is_permutation(found.order, n));
    CHECK(sg::elim::to_string(found.ec) ==
          sg::elim::to_string(sg::elim::elimination_complexity(pattern, found.order)));
    CHECK(sg::order::nested_dissection(graph, pattern.dim, n, 0).order == found.order);
    // A part of it, with the others after it in any order.
    const Index inner = n - draw(random, 1, n / 4);
    auto part = sg::order::nested_dissection(graph, pattern.dim, inner, 0);
    REQUIRE(sg::graph::is_permutation(part.order, inner));
    for (Index v = inner; v < n; ++v) part.order.push_back(v);
    const sg::elim::Symbolic symbolic = sg::elim::symbolic(pattern, part.order);
    sg::elim::Wide ec = 0;
    for (Index k = 0; k < inner; ++k) {
      ec += sg::elim::elimination_cost(symbolic.dim[k], symbolic.count[k]);
    }
    CHECK(sg::elim::to_string(part.ec) == sg::elim::to_string(ec));
  }
}

TEST_CASE("a part's greedy pass is exact beyond its budget, too", "[dissect]") {
  Random random(5);
  Pattern wide = odd_grid(random, 12);
  for (int k = 0; k < 2000; ++k) {
    const std::vector<Index> ends = shuffled(random, 144);
    wide.rows.add(std::vector<Index>{std::min(ends[0], ends[1]), std::max(ends[0], ends[1])});
  }
  const auto found = sg::order::greedy_fill_of_part(sg::graph::adjacency(wide), wide.dim, 144);
  CHECK(found.ec == sg::elim::elimination_complexity(wide, found.order));
}

TEST_CASE("a part's greedy pass is given up above its limit alone", "[dissect]") {
  Random random(10);
  const Pattern pattern = odd_grid(random, 14);
  const Adjacency graph = sg::graph::adjacency(pattern);
  const auto whole = sg::order::greedy_fill_of_part(graph, pattern.dim, 196);
  CHECK(sg::order::greedy_fill_of_part(graph, pattern.dim, 196, whole.ec).order == whole.order);
  CHECK(sg::order::greedy_fill_of_part(graph, pattern.dim, 196, whole.ec - 1).order.empty());
}

TEST_CASE("where minimum fill is better than dissection, dissection has it", "[dissect]") {
  // A street of ladders: narrow, so that the greedy order of the whole is hard to beat. It ends in something outside: a whole
  // graph's minimum fill is for the caller to try.
  Random random(11);
  constexpr Index length = 400, width = 3;
  std::vector<std::vector<Index>> rows;
  for (Index x = 0; x < length; ++x) {
    for (Index y = 0; y < width; ++y) {
      if (x + 1 < length) rows.push_back({x * width + y, (x + 1) * width + y});
      if (y + 1 < width) rows.push_back({x * width + y, x * width + y + 1});
    }
    if (x % 7 == 0 && x + 20 < length)
      rows.push_back({x * width, (x + draw(random, 5, 20)) * width});
  }
  const Pattern street = make_pattern(std::vector<int>(length * width, 3), rows);
  const Adjacency graph = sg::graph::adjacency(street);
  constexpr Index inner = length * width - 1;
  const auto greedy = sg::order::greedy_fill_of_part(graph, street.dim, inner);
  const auto found = sg::order::nested_dissection(graph, street.dim, inner, 0);
  CHECK(found.ec <= greedy.ec);
}

TEST_CASE("dissection orders any graph, and a wide one better than others do", "[dissect]") {
  Random random(6);
  for (int trial = 0; trial < 100; ++trial) {
    const Pattern pattern = odd_pattern(random, draw(random, 0, 59));
    const Order order = sg::order::dissect(sg::graph::adjacency(pattern), pattern.dim, 0);
    REQUIRE(sg::graph::is_permutation(order, pattern.variables()));
  }
  const Pattern wide = odd_grid(random, 90);
  const auto ec = [&](const Order& order) { return sg::elim::elimination_complexity(wide, order); };
  const sg::elim::Wide found = ec(sg::order::wmf(wide));
  CHECK(found < ec(sg::order::elimination_order("metis", wide)));
  CHECK(found < ec(sg::order::elimination_order("amd", wide)));
}
