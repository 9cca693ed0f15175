#include "lib/elim/structure.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "lib/elim/node_elimination.h"

using namespace sg;

TEST_CASE("separators are those of literal node elimination", "[elim][structure]") {
  std::mt19937 random(11);
  for (int trial = 0; trial < 200; ++trial) {
    const auto n = static_cast<Index>(random() % 40);
    Pattern pattern{std::vector<int>(n, 3), {}};
    for (auto r = n == 0 ? 0 : random() % (2 * n); r > 0; --r) {
      std::vector<Index> row;
      for (auto k = random() % 4; k > 0; --k) {
        const auto j = static_cast<Index>(random() % n);
        if (std::find(row.begin(), row.end(), j) == row.end()) row.push_back(j);
      }
      pattern.rows.add(row);
    }
    Order order(n);
    for (Index k = 0; k < n; ++k) order[k] = k;
    std::shuffle(order.begin(), order.end(), random);

    const auto steps = node_elimination(pattern, order);
    const OrderedPattern by_position = ordered(pattern, order);
    Index next = 0;
    visit_separators(by_position, elimination_tree(by_position),
                     [&](Index k, std::span<const Index> separator) {
                       REQUIRE(k == next++);
                       std::vector<Index> variables;
                       for (const Index i : separator) variables.push_back(order[i]);
                       CHECK(variables == steps[k].neighbours);
                     });
    CHECK(next == n);
  }
}
