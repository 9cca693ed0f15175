#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "formats/formats.h"
#include "lib/order/order.h"
#include "lib/order/region.h"
#include "tests/unit/common.h"

using namespace sg::test;

namespace {

using sg::Index;
using sg::graph::Order;
using sg::graph::Pattern;

}  // namespace

TEST_CASE("what a region gains by reordering, the whole elimination gains", "[best]") {
  Random random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    const Index n = draw(random, 1, 40);
    const Pattern pattern = odd_pattern(random, n);
    const Order start =
        trial % 2 == 0 ? shuffled(random, n) : sg::order::elimination_order("amd", pattern);
    const sg::order::Elimination before = sg::order::elimination(pattern, start);
    REQUIRE(before.ec == sg::elim::elimination_complexity(pattern, start));
    REQUIRE(before.ec == sg::elim::elimination_complexity(pattern, before.order));

    const Index root = draw(random, 0, n - 1);
    const Index size = draw(random, 1, n);
    const sg::order::Region part = sg::order::region(before, root, size);
    const auto inside = static_cast<Index>(part.inside.size());
    REQUIRE(inside == std::min(size, root - before.first[root] + 1));

    Order local(part.pattern.variables());
    std::iota(local.begin(), local.end(), 0);
    CHECK(sg::order::region_ec(part, local) == part.ec);
    for (Index k = inside; k > 1; --k) std::swap(local[k - 1], local[draw(random, 0, k - 1)]);
    const std::vector<Index> subtree = sg::order::reordered_subtree(before, part, local);
    Order after = before.order;
    std::copy(subtree.begin(), subtree.end(), after.begin() + before.first[root]);
    REQUIRE(sg::elim::elimination_complexity(pattern, after) + part.ec ==
            before.ec + sg::order::region_ec(part, local));
  }
}

TEST_CASE("best is never above another method, and says what it found", "[best]") {
  Random random(2);
  for (int trial = 0; trial < 40; ++trial) {
    const Index n = trial < 3 ? trial : draw(random, 0, 79);
    const Pattern pattern = odd_pattern(random, n);
    sg::order::OrderOptions options;
    options.seed = static_cast<std::uint64_t>(trial);
    options.budget.tries = trial % 4 == 0 ? 0 : draw(random, 0, 99);
    if (trial % 3 == 0) {
      const Order some = shuffled(random, n);
      options.last.assign(some.begin(), some.begin() + n / 4);
    }
    std::vector<sg::elim::Wide> found;
    options.report = [&](const sg::order::Improvement& improvement) {
      found.push_back(improvement.ec);
    };
    const Order order = sg::order::elimination_order("best", pattern, options);
    const sg::elim::Wide ec = sg::elim::elimination_complexity(pattern, order);
    REQUIRE(!found.empty());
    CHECK(found.back() == ec);
    CHECK(std::is_sorted(found.rbegin(), found.rend()));
    CHECK(sg::order::elimination_order("best", pattern, options) == order);
    for (const sg::order::Ordering& method : sg::order::orderings()) {
      INFO(method.name);
      if (method.name == "best") continue;
      const Order other = sg::order::elimination_order(method, pattern, options);
      CHECK(ec <= sg::elim::elimination_complexity(pattern, other));
    }
  }
}

TEST_CASE("more tries are never worse, nor are seconds", "[best]") {
  Random random(3);
  const Pattern pattern = odd_pattern(random, 300);
  const auto ec = [&](int tries, double seconds) {
    sg::order::OrderOptions options;
    options.budget = {tries, seconds};
    return sg::elim::elimination_complexity(pattern,
                                            sg::order::elimination_order("best", pattern, options));
  };
  const sg::elim::Wide none = ec(0, 0);
  const sg::elim::Wide few = ec(64, 0);
  CHECK(few <= none);
  CHECK(ec(320, 0) <= few);
  CHECK(ec(0, 0.2) <= none);
}

TEST_CASE("best without any time is amd, and with some never worse", "[best]") {
  Random random(4);
  for (int trial = 0; trial < 60; ++trial) {
    const Index n = draw(random, 1, 200);
    const Pattern pattern = odd_pattern(random, n);
    const sg::elim::Wide amd =
        sg::elim::elimination_complexity(pattern, sg::order::elimination_order("amd", pattern));
    sg::order::OrderOptions options;
    options.budget = {0, trial % 3 == 0 ? 1e-9 : 1e-4 * trial};
    if (trial % 4 == 0) options.stop = [] { return true; };
    const Order order = sg::order::elimination_order("best", pattern, options);
    REQUIRE(sg::graph::is_permutation(order, n));
    const sg::elim::Wide ec = sg::elim::elimination_complexity(pattern, order);
    CHECK(ec <= amd);
    if (trial % 3 == 0) CHECK(ec == amd);
  }
}

TEST_CASE("best for a price has the least of it", "[best]") {
  Random random(5);
  for (int trial = 0; trial < 20; ++trial) {
    const Index n = draw(random, 1, 80);
    const Pattern pattern = odd_pattern(random, n);
    sg::order::OrderOptions options;
    options.budget.tries = trial % 2 == 0 ? 0 : 48;
    // The depth of the elimination tree, which has little to do with EC.
    options.price = [](const Pattern& of, const Order& order) {
      return static_cast<double>(sg::elim::height(sg::elim::symbolic(of, order).parent));
    };
    double told = 0;
    options.report = [&](const sg::order::Improvement& better) { told = better.price; };
    const Order order = sg::order::elimination_order("best", pattern, options);
    CHECK(options.price(pattern, order) == told);
    for (const char* method : {"id", "colamd", "amd", "wmf", "metis", "rcm"})
      CHECK(told <= options.price(pattern, sg::order::elimination_order(method, pattern)));
  }
}

TEST_CASE("best improves on every method on public graphs", "[best][data]") {
  const auto folder = public_graphs();
  if (!folder) return;
  for (const char* file : {"smallGrid3D.g2o", "intel.g2o", "manhattan.g2o"}) {
    INFO(file);
    const Pattern pattern =
        sg::graph::graph_pattern(sg::formats::read_graph(*folder + "/" + file)).pattern;
    std::string last;
    sg::order::OrderOptions options;
    options.report = [&](const sg::order::Improvement& improvement) { last = improvement.how; };
    sg::order::elimination_order("best", pattern, options);
    CHECK((last == "local" || last == "restart"));
  }
}
