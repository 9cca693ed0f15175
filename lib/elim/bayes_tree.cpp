#include "lib/elim/bayes_tree.h"

#include <algorithm>
#include <array>
#include <span>

namespace sg {
namespace {

// The same groups, the last first.
Groups reversed(const Groups& groups) {
  Groups result;
  result.begin.reserve(groups.begin.size());
  result.begin.push_back(0);
  result.items.reserve(groups.items.size());
  for (Index k = groups.size() - 1; k >= 0; --k) {
    result.items.insert(result.items.end(), groups[k].begin(), groups[k].end());
    result.begin.push_back(static_cast<Index>(result.items.size()));
  }
  return result;
}

}  // namespace

BayesTree bayes_tree(const Symbolic& symbolic) {
  const auto n = static_cast<Index>(symbolic.parent.size());
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

Groups clique_frontals(const BayesTree& tree) {
  return grouped(tree.clique, tree.cliques());
}

Groups clique_separators(const OrderedPattern& pattern, const BayesTree& tree) {
  const Index cliques = tree.cliques();
  const Groups children = grouped(tree.parent, cliques);
  std::vector<Index> row_clique(pattern.rows());
  for (Index r = 0; r < pattern.rows(); ++r) row_clique[r] = tree.clique[pattern.row(r).front()];
  const Groups rows = grouped(row_clique, cliques);

  // From the leaves up: list c belongs to clique (cliques - 1 - c) until the end.
  Groups result;
  result.begin.push_back(0);
  std::vector<Index> seen(pattern.variables(), -1);
  for (Index c = cliques - 1; c >= 0; --c) {
    const auto take = [&](std::span<const Index> positions) {
      for (Index p : positions) {
        if (tree.clique[p] == c || seen[p] == c) continue;
        seen[p] = c;
        result.items.push_back(p);
      }
    };
    for (Index r : rows[c]) take(pattern.row(r));
    for (Index child : children[c]) {
      // By index: `take` may move the items.
      const Index list = cliques - 1 - child;
      for (Index i = result.begin[list]; i < result.begin[list + 1]; ++i)
        take(std::array{result.items[i]});
    }
    result.begin.push_back(static_cast<Index>(result.items.size()));
  }
  return reversed(result);
}

Wide elimination_complexity(const BayesTree& tree) {
  Wide ec = 0;
  for (Index c = 0; c < tree.cliques(); ++c)
    ec += elimination_cost(tree.frontal_dim[c], tree.total_dim[c]);
  return ec;
}

}  // namespace sg
