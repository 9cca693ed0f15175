#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "formats/formats.h"
#include "lib/order/order.h"
#include "lib/order/region.h"

namespace {

using sg::Index;
using sg::Order;
using sg::Pattern;

// Rows of one to four variables, of dimension 1 to 6; sparse enough for a tree with branches.
Pattern odd_pattern(std::mt19937& random, Index n) {
  Pattern pattern;
  for (Index j = 0; j < n; ++j) pattern.dim.push_back(1 + static_cast<int>(random() % 6));
  for (auto rows = n == 0 ? 0 : random() % (2 * n); rows > 0; --rows) {
    for (auto k = 1 + random() % 4; k > 0; --k) {
      const auto j = static_cast<Index>(random() % n);
      const auto row = pattern.rows.open();
      if (std::find(row.begin(), row.end(), j) == row.end()) pattern.rows.items.push_back(j);
    }
    pattern.rows.close();
  }
  return pattern;
}

Order shuffled(std::mt19937& random, Index n) {
  Order order(n);
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), random);
  return order;
}

}  // namespace

TEST_CASE("what a region gains by reordering, the whole elimination gains", "[best]") {
  std::mt19937 random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    const auto n = static_cast<Index>(1 + random() % 40);
    const Pattern pattern = odd_pattern(random, n);
    const Order start =
        trial % 2 == 0 ? shuffled(random, n) : sg::elimination_order("amd", pattern);
    const sg::OrderedElimination before = sg::elimination(pattern, start);
    REQUIRE(before.ec == sg::elimination_complexity(pattern, start));
    REQUIRE(before.ec == sg::elimination_complexity(pattern, before.order));

    const auto root = static_cast<Index>(random() % n);
    const auto size = static_cast<Index>(1 + random() % n);
    const sg::Region part = sg::region(before, root, size);
    const auto inside = static_cast<Index>(part.inside.size());
    REQUIRE(inside == std::min(size, root - before.first[root] + 1));

    Order local(part.pattern.variables());
    std::iota(local.begin(), local.end(), 0);
    CHECK(sg::region_ec(part, local) == part.ec);
    std::shuffle(local.begin(), local.begin() + inside, random);
    const std::vector<Index> subtree = sg::reordered_subtree(before, part, local);
    Order after = before.order;
    std::copy(subtree.begin(), subtree.end(), after.begin() + before.first[root]);
    REQUIRE(sg::elimination_complexity(pattern, after) + part.ec ==
            before.ec + sg::region_ec(part, local));
  }
}

TEST_CASE("best is never above another method, and says what it found", "[best]") {
  std::mt19937 random(2);
  for (int trial = 0; trial < 40; ++trial) {
    const auto n = static_cast<Index>(trial < 3 ? trial : random() % 80);
    const Pattern pattern = odd_pattern(random, n);
    sg::OrderOptions options;
    options.seed = static_cast<std::uint64_t>(trial);
    options.budget.tries = trial % 4 == 0 ? 0 : static_cast<int>(random() % 100);
    if (trial % 3 == 0) {
      const Order some = shuffled(random, n);
      options.last.assign(some.begin(), some.begin() + n / 4);
    }
    std::vector<sg::Wide> found;
    options.report = [&](const sg::Improvement& improvement) { found.push_back(improvement.ec); };
    const Order order = sg::elimination_order("best", pattern, options);
    const sg::Wide ec = sg::elimination_complexity(pattern, order);
    REQUIRE(!found.empty());
    CHECK(found.back() == ec);
    CHECK(std::is_sorted(found.rbegin(), found.rend()));
    CHECK(sg::elimination_order("best", pattern, options) == order);
    for (const sg::Ordering& method : sg::orderings()) {
      INFO(method.name);
      if (method.name == "best") continue;
      const Order other = sg::elimination_order(method, pattern, options);
      CHECK(ec <= sg::elimination_complexity(pattern, other));
    }
  }
}

TEST_CASE("more tries are never worse, and seconds are kept", "[best]") {
  std::mt19937 random(3);
  const Pattern pattern = odd_pattern(random, 300);
  const auto ec = [&](int tries, double seconds) {
    sg::OrderOptions options;
    options.budget = {tries, seconds};
    return sg::elimination_complexity(pattern, sg::elimination_order("best", pattern, options));
  };
  const sg::Wide none = ec(0, 0);
  const sg::Wide few = ec(64, 0);
  CHECK(few <= none);
  CHECK(ec(320, 0) <= few);
  CHECK(ec(0, 0.2) <= none);
}

TEST_CASE("best improves on every method on public graphs", "[best][data]") {
  const char* data = std::getenv("SGTOOLS_DATA");
  if (!data) {
    std::cout << "skipped: best on public graphs (SGTOOLS_DATA is not set)\n";
    return;
  }
  for (const char* file : {"smallGrid3D.g2o", "intel.g2o", "manhattan.g2o"}) {
    INFO(file);
    const Pattern pattern =
        sg::graph_pattern(sg::read_graph(std::string(data) + "/" + file)).pattern;
    std::string last;
    sg::OrderOptions options;
    options.report = [&](const sg::Improvement& improvement) { last = improvement.how; };
    sg::elimination_order("best", pattern, options);
    CHECK((last == "local" || last == "restart"));
  }
}
