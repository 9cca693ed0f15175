#include "lib/elim/structure.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "lib/elim/bayes_tree.h"
#include "lib/elim/clique_lists.h"
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

TEST_CASE("cliques in one pass are those of the Bayes tree, with its separators",
          "[elim][structure]") {
  Random random(12);
  for (int trial = 0; trial < 400; ++trial) {
    const Index n = draw(random, 0, 39);
    const graph::Pattern pattern = odd_pattern(random, n);
    const graph::Order order = shuffled(random, n);
    const elim::OrderedPattern by_position = elim::ordered(pattern, order);
    const elim::BayesTree tree = elim::bayes_tree(elim::symbolic(pattern, order));
    const graph::Lists<> separators = elim::clique_separators(by_position, tree);

    const elim::CliqueLists lists = elim::clique_lists(pattern, order);
    REQUIRE(lists.cliques() == tree.cliques());
    const auto other = [&](Index c) { return c < 0 ? -1 : tree.cliques() - 1 - c; };
    for (Index k = 0; k < n; ++k) CHECK(lists.clique[k] == other(tree.clique[k]));
    for (Index c = 0; c < tree.cliques(); ++c) {
      const Index own = other(c);
      CHECK(lists.parent[own] == other(tree.parent[c]));
      CHECK(lists.frontal_dim[own] == tree.frontal_dim[c]);
      CHECK(lists.separator_dim[own] == tree.total_dim[c] - tree.frontal_dim[c]);
      std::vector<Index> expected(separators[c].begin(), separators[c].end());
      std::ranges::sort(expected);
      CHECK(std::ranges::equal(lists.separator(own), expected));
    }
    for (Index r = 0; r < pattern.rows.size(); ++r) {
      Index first = -1;
      for (Index k = n - 1; k >= 0; --k) {
        if (std::ranges::count(pattern.rows[r], order[k]) > 0) first = k;
      }
      CHECK(lists.row_first[r] == first);
    }
  }
}
