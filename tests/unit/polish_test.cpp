// Polishing: never worse, exactly what it says, and what a cut's regions gain the whole gains.
#include "lib/order/polish.h"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <numeric>

#include "formats/formats.h"
#include "lib/order/order.h"
#include "lib/order/region.h"
#include "tests/unit/common.h"

using namespace sg::test;

namespace {

using sg::Index;
using sg::graph::Order;
using sg::graph::Pattern;

Order any_order(Random& random, const Pattern& pattern, int trial) {
  return trial % 2 == 0 ? shuffled(random, pattern.variables())
                        : sg::order::elimination_order("amd", pattern);
}

}  // namespace

TEST_CASE("a cut's regions cover the elimination, each as it is by itself", "[polish]") {
  Random random(1);
  for (int trial = 0; trial < 500; ++trial) {
    const Index n = draw(random, 0, 40);
    const Pattern pattern = odd_pattern(random, n);
    const auto whole = sg::order::elimination(pattern, any_order(random, pattern, trial));
    const Index size = draw(random, 1, 12);
    const auto regions = sg::order::cut(whole, size, std::vector<bool>(n, false));
    std::vector<Index> covered;
    for (const auto& part : regions) {
      covered.insert(covered.end(), part.inside.begin(), part.inside.end());
      const auto alone = sg::order::region(whole, part.root, size);
      CHECK(part.inside == alone.inside);
      CHECK(part.pattern.dim == alone.pattern.dim);
      CHECK(part.ec == alone.ec);
      Order local(part.pattern.variables());
      std::iota(local.begin(), local.end(), 0);
      CHECK(sg::order::region_ec(part, local) == part.ec);
    }
    std::ranges::sort(covered);
    Order all(n);
    std::iota(all.begin(), all.end(), 0);
    CHECK(covered == all);
    CHECK(sg::order::recut(whole, regions, std::vector<Order>(regions.size())).size() ==
          covered.size());
  }
}

TEST_CASE("what all regions of a cut gain together, the whole elimination gains", "[polish]") {
  Random random(2);
  for (int trial = 0; trial < 1000; ++trial) {
    const Index n = draw(random, 1, 50);
    const Pattern pattern = odd_pattern(random, n);
    const auto before = sg::order::elimination(pattern, any_order(random, pattern, trial));
    const auto regions = sg::order::cut(before, draw(random, 1, 12), std::vector<bool>(n, false));
    std::vector<Order> orders;
    sg::elim::Wide was = 0, is = 0;
    for (const auto& part : regions) {
      const auto inside = static_cast<Index>(part.inside.size());
      Order local(part.pattern.variables());
      std::iota(local.begin(), local.end(), 0);
      for (Index k = inside; k > 1; --k) std::swap(local[k - 1], local[draw(random, 0, k - 1)]);
      was += part.ec;
      is += sg::order::region_ec(part, local);
      orders.push_back(local);
    }
    const Order after = sg::order::recut(before, regions, orders);
    REQUIRE(before.ec == was);
    REQUIRE(sg::elim::elimination_complexity(pattern, after) == is);
  }
}

TEST_CASE("what exchanges of cliques promise, the whole elimination gains", "[polish]") {
  Random random(5);
  int exchanged = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Index n = draw(random, 1, 50);
    const Pattern pattern = odd_pattern(random, n);
    const auto before = sg::order::elimination(pattern, any_order(random, pattern, trial));
    std::vector<Order> orders;
    const auto regions = sg::order::exchanges(before, std::vector<bool>(n, false), orders);
    REQUIRE(regions.size() == orders.size());
    std::size_t covered = 0;
    sg::elim::Wide gain = 0;
    for (std::size_t k = 0; k < regions.size(); ++k) {
      covered += regions[k].inside.size();
      if (orders[k].empty()) continue;
      const sg::elim::Wide ec = sg::order::region_ec(regions[k], orders[k]);
      REQUIRE(ec < regions[k].ec);
      gain += regions[k].ec - ec;
      ++exchanged;
    }
    REQUIRE(covered == before.order.size());
    const Order after = sg::order::recut(before, regions, orders);
    REQUIRE(sg::elim::elimination_complexity(pattern, after) + gain == before.ec);
  }
  CHECK(exchanged > 500);
}

TEST_CASE("a polished order is never worse, and costs what it says", "[polish]") {
  Random random(3);
  int better = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Index n = draw(random, 0, trial % 20 == 0 ? 400 : 60);
    const Pattern pattern = odd_pattern(random, n);
    sg::order::PolishOptions options;
    if (trial % 3 == 0) {
      options.last = shuffled(random, n);
      options.last.resize(n / 4);
    }
    Order order = any_order(random, pattern, trial);
    std::vector<bool> is_last(n, false);
    for (const Index j : options.last) is_last[j] = true;
    std::stable_partition(order.begin(), order.end(), [&](Index j) { return !is_last[j]; });
    const sg::elim::Wide before = sg::elim::elimination_complexity(pattern, order);
    const sg::order::Polished polished = sg::order::polish(pattern, order, options);
    REQUIRE(sg::graph::is_permutation(polished.order, n));
    CHECK(polished.ec == sg::elim::elimination_complexity(pattern, polished.order));
    CHECK(polished.ec <= before);
    CHECK(std::ranges::is_partitioned(polished.order, [&](Index j) { return !is_last[j]; }));
    CHECK(sg::order::polish(pattern, order, options).order == polished.order);
    better += polished.ec < before;
  }
  CHECK(better > 200);
}

TEST_CASE("a polished order fills nothing in that no triangulation needs", "[polish]") {
  Random random(6);
  int slimmer = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Index n = draw(random, 1, 30);
    const Pattern pattern = odd_pattern(random, n);
    const Order before = any_order(random, pattern, trial);
    const auto polished = sg::order::polish(pattern, before);
    // The graph, and the same filled in by playing the elimination.
    std::vector<std::vector<char>> edge(n, std::vector<char>(n, 0));
    for (Index r = 0; r < pattern.rows.size(); ++r) {
      for (const Index u : pattern.rows[r]) {
        for (const Index v : pattern.rows[r]) edge[u][v] = u != v;
      }
    }
    const auto filled = [&](const Order& order) {
      auto result = edge;
      for (Index k = 0; k < n; ++k) {
        for (Index a = k + 1; a < n; ++a) {
          for (Index b = k + 1; b < n; ++b) {
            const Index u = order[a], v = order[b];
            if (u != v && result[order[k]][u] && result[order[k]][v]) result[u][v] = 1;
          }
        }
      }
      return result;
    };
    // An edge of a chordal graph can go, and it stays chordal, if all that both its ends know know one another.
    const auto unneeded = [&](const std::vector<std::vector<char>>& graph) {
      int count = 0;
      for (Index u = 0; u < n; ++u) {
        for (Index v = 0; v < u; ++v) {
          if (!graph[u][v] || edge[u][v]) continue;
          bool clique = true;
          for (Index a = 0; a < n; ++a) {
            for (Index b = 0; b < a; ++b) {
              const bool common = graph[u][a] && graph[v][a] && graph[u][b] && graph[v][b];
              if (common && !graph[a][b]) clique = false;
            }
          }
          count += clique;
        }
      }
      return count;
    };
    CHECK(unneeded(filled(polished.order)) == 0);
    slimmer += unneeded(filled(before)) > 0;
  }
  CHECK(slimmer > 50);
}

TEST_CASE("polishing stops when it is told to", "[polish]") {
  Random random(4);
  const Pattern pattern = odd_pattern(random, 60);
  const Order order = shuffled(random, 60);
  const auto at_once =
      sg::order::polish(pattern, order, {.last = {}, .stop = [](double) { return true; }});
  CHECK(at_once.ec == sg::elim::elimination_complexity(pattern, order));
  std::atomic<int> asked = 0;
  const auto soon =
      sg::order::polish(pattern, order, {.last = {}, .stop = [&](double) { return ++asked > 2; }});
  CHECK(soon.ec <= at_once.ec);
}

TEST_CASE("public orders get better by polishing", "[polish][data]") {
  const auto folder = public_graphs();
  if (!folder) return;
  for (const char* file : {"smallGrid3D.g2o", "intel.g2o", "manhattan.g2o"}) {
    INFO(file);
    const Pattern pattern =
        sg::graph::graph_pattern(sg::formats::read_graph(*folder + "/" + file)).pattern;
    const Order order = sg::order::elimination_order("amd", pattern);
    CHECK(sg::order::polish(pattern, order).ec < sg::elim::elimination_complexity(pattern, order));
  }
}
