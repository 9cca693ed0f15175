#include "lib/elim/bayes_tree.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <span>

namespace sg::elim {
namespace {

graph::Lists<> reversed(const graph::Lists<>& lists) {
  graph::Lists<> result;
  result.begin.reserve(lists.begin.size());
  result.items.reserve(lists.items.size());
  for (Index k = lists.size() - 1; k >= 0; --k) result.add(lists[k]);
  return result;
}

}  // namespace

BayesTree bayes_tree(const Symbolic& symbolic) {
  const auto n = static_cast<Index>(symbolic.parent.size());
  assert(symbolic.dim.size() == symbolic.parent.size());
  assert(symbolic.count.size() == symbolic.parent.size());
  BayesTree tree;
  tree.clique.assign(n, -1);
  std::vector<bool> topped(n, false);  // a child has joined on top of this position
  for (Index i = n - 1; i >= 0; --i) {
    const Index p = symbolic.parent[i];
    const bool joins =
        p >= 0 && !topped[p] && symbolic.count[i] - symbolic.dim[i] == symbolic.count[p];
    if (joins) {
      topped[p] = true;
      const Index c = tree.clique[p];
      tree.clique[i] = c;
      tree.frontal_dim[c] += symbolic.dim[i];
      tree.total_dim[c] = std::max(tree.total_dim[c], symbolic.count[i]);
      continue;
    }
    tree.clique[i] = tree.cliques();
    tree.parent.push_back(p < 0 ? -1 : tree.clique[p]);
    tree.top.push_back(i);
    tree.frontal_dim.push_back(symbolic.dim[i]);
    tree.total_dim.push_back(symbolic.count[i]);
  }
  return tree;
}

graph::Lists<> clique_frontals(const BayesTree& tree) {
  return graph::grouped(tree.clique, tree.cliques());
}

graph::Lists<> clique_separators(const OrderedPattern& pattern, const BayesTree& tree) {
  const Index cliques = tree.cliques();
  assert(tree.clique.size() == pattern.dim.size());
  const graph::Lists<> children = graph::grouped(tree.parent, cliques);
  std::vector<Index> row_clique(pattern.rows.size());
  for (Index r = 0; r < pattern.rows.size(); ++r)
    row_clique[r] = tree.clique[pattern.rows[r].front()];
  const graph::Lists<> rows = graph::grouped(row_clique, cliques);

  // From the leaves up: list c belongs to clique (cliques - 1 - c) until the end.
  graph::Lists<> result;
  std::vector<Index> seen(pattern.variables(), -1);
  for (Index c = cliques - 1; c >= 0; --c) {
    const auto take = [&](std::span<const Index> positions) {
      for (Index p : positions) {
        if (tree.clique[p] == c || seen[p] == c) continue;
        seen[p] = c;
        result.items.push_back(p);
      }
    };
    for (Index r : rows[c]) take(pattern.rows[r]);
    for (Index child : children[c]) {
      // By index: `take` may move the items.
      const Index list = cliques - 1 - child;
      for (Index i = result.begin[list]; i < result.begin[list + 1]; ++i)
        take(std::array{result.items[i]});
    }
    result.close();
  }
  return reversed(result);
}

Wide elimination_complexity(const BayesTree& tree) {
  Wide ec = 0;
  for (Index c = 0; c < tree.cliques(); ++c)
    ec += elimination_cost(tree.frontal_dim[c], tree.total_dim[c]);
  return ec;
}

}  // namespace sg::elim
