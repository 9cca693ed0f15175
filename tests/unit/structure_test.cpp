#include "lib/elim/structure.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "lib/elim/node_elimination.h"
#include "tests/unit/common.h"

using namespace sg;
using namespace sg::test;

TEST_CASE("separators are those of literal node elimination", "[elim][structure]") {
  Random random(11);
  for (int trial = 0; trial < 200; ++trial) {
    const Index n = draw(random, 0, 39);
    const graph::Pattern pattern = odd_pattern(random, n);
    const graph::Order order = shuffled(random, n);

    const auto steps = elim::node_elimination(pattern, order);
    const elim::OrderedPattern by_position = elim::ordered(pattern, order);
    Index next = 0;
    elim::visit_separators(by_position, elim::elimination_tree(by_position),
                           [&](Index k, std::span<const Index> separator) {
                             REQUIRE(k == next++);
                             std::vector<Index> variables;
                             for (const Index i : separator) variables.push_back(order[i]);
                             CHECK(variables == steps[k].neighbours);
                           });
    CHECK(next == n);
  }
}
