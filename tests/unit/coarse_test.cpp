#include "lib/order/coarse.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "lib/order/order.h"
#include "tests/unit/common.h"

using namespace sg::test;

namespace {

using sg::Index;
using sg::graph::Order;
using sg::graph::Pattern;

Pattern grid(Index length, Index width) {
  std::vector<std::vector<Index>> rows;
  for (Index x = 0; x < length; ++x) {
    for (Index y = 0; y < width; ++y) {
      if (x + 1 < length) rows.push_back({x * width + y, (x + 1) * width + y});
      if (y + 1 < width) rows.push_back({x * width + y, x * width + y + 1});
    }
  }
  return make_pattern(std::vector<int>(static_cast<std::size_t>(length * width), 3), rows);
}

Order coarse(const Pattern& pattern, Index leaf) {
  return sg::order::coarse_dissection(sg::graph::adjacency(pattern), leaf);
}

// The place of every vertex in an order.
std::vector<Index> places(const Order& order) {
  std::vector<Index> result(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) result[order[k]] = static_cast<Index>(k);
  return result;
}

}  // namespace

TEST_CASE("a coarse dissection orders any graph, down to any leaf", "[coarse]") {
  Random random(1);
  for (int trial = 0; trial < 500; ++trial) {
    const Index n = draw(random, 0, 80);
    const Pattern pattern = odd_pattern(random, n);
    REQUIRE(sg::graph::is_permutation(coarse(pattern, draw(random, 1, 40)), n));
  }
}

TEST_CASE("a level in the middle of a corridor parts it, and goes last", "[coarse]") {
  constexpr Index length = 40, width = 5;
  const std::vector<Index> place = places(coarse(grid(length, width), 100));
  // The search begins in a corner: its levels are diagonals of at most `width`.
  const auto in_separator = [&](Index v) { return place[v] >= (length - 1) * width; };
  std::vector<int> side(length * width, -1);
  for (Index start = 0, sides = 0; start < length * width; ++start) {
    if (side[start] >= 0 || in_separator(start)) continue;
    REQUIRE(sides < 2);
    std::vector<Index> stack{start};
    side[start] = sides;
    Index size = 0;
    while (!stack.empty()) {
      const Index v = stack.back();
      stack.pop_back();
      ++size;
      for (const Index u :
           {v - width, v + width, v % width ? v - 1 : -1, (v + 1) % width ? v + 1 : -1}) {
        if (u < 0 || u >= length * width || side[u] >= 0 || in_separator(u)) continue;
        side[u] = sides;
        stack.push_back(u);
      }
    }
    CHECK(size >= length * width / 4);
    ++sides;
  }
  // One side is before the other in the order.
  Index last_of[2] = {-1, -1}, first_of[2] = {length * width, length * width};
  for (Index v = 0; v < length * width; ++v) {
    if (in_separator(v)) continue;
    last_of[side[v]] = std::max(last_of[side[v]], place[v]);
    first_of[side[v]] = std::min(first_of[side[v]], place[v]);
  }
  CHECK((last_of[0] < first_of[1] || last_of[1] < first_of[0]));
}

TEST_CASE("leaves are ordered with what is around them in mind", "[coarse]") {
  const auto ec = [](const Pattern& pattern, const Order& order) {
    return sg::elim::to_double(sg::elim::elimination_complexity(pattern, order));
  };
  for (const Pattern& pattern : {grid(60, 60), grid(300, 12), grid(1000, 2)}) {
    const Index n = pattern.variables();
    const double by_amd = ec(pattern, sg::order::elimination_order("amd", pattern));
    CHECK(ec(pattern, coarse(pattern, n)) == by_amd);
    CHECK(ec(pattern, coarse(pattern, n / 8)) < 2.2 * by_amd);
  }
}

TEST_CASE("a coarse dissection: the same order by any number of threads", "[coarse][parallel]") {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
  const Pattern pattern = grid(70, 60);
  const Order one = tbb::task_arena(1).execute([&] { return coarse(pattern, 100); });
  for (int repeat = 0; repeat < 5; ++repeat)
    CHECK(tbb::task_arena(4).execute([&] { return coarse(pattern, 100); }) == one);
}

TEST_CASE("where amd would outlast the budget, best is a coarse dissection", "[best][coarse]") {
  const Pattern pattern = grid(260, 200);
  sg::order::OrderOptions options;
  options.budget.seconds = 1e-9;
  options.last = {7, 300};
  std::vector<std::string> told;
  options.report = [&](const sg::order::Improvement& found) { told.emplace_back(found.how); };
  Order expected = coarse(pattern, pattern.variables() / 8);
  std::erase_if(expected, [](Index v) { return v == 7 || v == 300; });
  const Order found = sg::order::elimination_order("best", pattern, options);
  CHECK(told == std::vector<std::string>{"coarse"});
  CHECK(Order(found.begin(), found.end() - 2) == expected);
}
