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

}  // namespace sg
