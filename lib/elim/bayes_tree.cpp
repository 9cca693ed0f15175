#include "lib/elim/bayes_tree.h"

#include <algorithm>

namespace sg {

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

std::vector<std::vector<Index>> clique_frontals(const BayesTree& tree) {
  std::vector<std::vector<Index>> result(tree.cliques());
  for (Index k = 0; k < static_cast<Index>(tree.clique.size()); ++k)
    result[tree.clique[k]].push_back(k);
  return result;
}

std::vector<std::vector<Index>> clique_separators(const OrderedPattern& pattern,
                                                  const BayesTree& tree) {
  // What a clique's variables meet beyond the clique: in factors, and through its children.
  std::vector<std::vector<Index>> result(tree.cliques());
  const auto add = [&](Index c, std::span<const Index> positions) {
    for (const Index k : positions) {
      if (k > tree.top[c]) result[c].push_back(k);
    }
  };
  for (Index r = 0; r < pattern.rows(); ++r) {
    const auto row = pattern.row(r);
    add(tree.clique[row.front()], row);
  }
  for (Index c = tree.cliques() - 1; c >= 0; --c) {
    std::sort(result[c].begin(), result[c].end());
    result[c].erase(std::unique(result[c].begin(), result[c].end()), result[c].end());
    if (tree.parent[c] >= 0) add(tree.parent[c], result[c]);
  }
  return result;
}

}  // namespace sg
