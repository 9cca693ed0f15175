#include "lib/solve/clique_tree.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "lib/elim/clique_lists.h"
#include "lib/elim/etree.h"
#include "lib/solve/assembly.h"

namespace sg::solve {
namespace {

// Nanoseconds, roughly, that a front of f frontal and n rows takes: a fixed part, a pass over its
// numbers, and the multiplications. Only the ratio of the three matters.
double front_time(double f, double n) {
  const double flops = f * (n * n - f * n + f * f / 3);
  return 150 + 0.4 * n * n + 10 * f + 0.04 * flops;
}

// The same of a leaf that is kept as its factor (assembly.h), and of what its parent takes from it.
double leaf_time(double f, double n) {
  const double s = n - f;
  return 150 + 0.4 * f * n + 10 * f + (0.06 + 0.02 * f) * s * s;
}

// Sets the clique that each of the Bayes tree's becomes part of; itself stands where it stays
// alone.
void merge_into_parents(const elim::CliqueLists& tree, int relaxed_from,
                        std::vector<Index>& target) {
  const Index cliques = tree.cliques();
  std::vector<double> f(tree.frontal_dim.begin(), tree.frontal_dim.end());
  std::vector<double> n(cliques);
  for (Index c = 0; c < cliques; ++c)
    n[c] = f[c] + tree.separator_dim[c] + 1;  // with the right-hand side
  const std::vector<bool> leaf = childless(tree.parent);
  // Children come before their parents, so that a clique is complete when its own turn comes.
  for (Index c = 0; c < cliques; ++c) {
    const Index p = tree.parent[c];
    if (p < 0 || n[c] < relaxed_from) continue;
    const bool factor =
        leaf[c] && stays_factor(static_cast<int>(f[c]), static_cast<int>(n[c] - f[c]) - 1);
    const double passage = 0.5 * (n[c] - f[c]) * (n[c] - f[c]);
    const double own = factor ? leaf_time(f[c], n[c]) : front_time(f[c], n[c]) + passage;
    if (front_time(f[c] + f[p], f[c] + n[p]) > own + front_time(f[p], n[p])) continue;
    target[c] = p;
    f[p] += f[c];
    n[p] += f[c];
  }
  for (Index c = cliques - 1; c >= 0; --c) target[c] = target[target[c]];
}

// Numbers the merged cliques in postorder: of every clique of the Bayes tree the number of the one
// that it is part of. Fills in the parents.
std::vector<Index> number_cliques(const elim::CliqueLists& tree, const std::vector<Index>& target,
                                  CliqueTree& result) {
  std::vector<Index> rank(tree.cliques(), -1);  // among those that stay, children before parents
  std::vector<Index> kept;
  for (Index c = 0; c < tree.cliques(); ++c) {
    if (target[c] != c) continue;
    rank[c] = static_cast<Index>(kept.size());
    kept.push_back(c);
  }
  std::vector<Index> parent(kept.size());
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const Index p = tree.parent[kept[k]];
    parent[k] = p < 0 ? -1 : rank[target[p]];
  }
  const std::vector<Index> number = elim::postorder_ranks(parent, elim::subtree_sizes(parent));
  result.parent.resize(parent.size());
  for (std::size_t k = 0; k < parent.size(); ++k)
    result.parent[number[k]] = parent[k] < 0 ? -1 : number[parent[k]];

  std::vector<Index> clique(tree.cliques());
  for (Index c = 0; c < tree.cliques(); ++c) clique[c] = number[rank[target[c]]];
  return clique;
}

// Dimensions, and what the Bayes tree's own cliques cost.
void sum_up(const elim::CliqueLists& tree, const std::vector<Index>& clique,
            const std::vector<Index>& target, CliqueTree& result) {
  const auto cliques = result.parent.size();
  result.frontal_dim.assign(cliques, 0);
  result.separator_dim.assign(cliques, 0);
  result.ec.assign(cliques, 0);
  result.merged.assign(cliques, 0);
  for (Index c = 0; c < tree.cliques(); ++c) {
    const Index k = clique[c];
    result.frontal_dim[k] += tree.frontal_dim[c];
    if (target[c] == c) result.separator_dim[k] = tree.separator_dim[c];
    const std::int64_t total = std::int64_t{tree.frontal_dim[c]} + tree.separator_dim[c];
    result.ec[k] += tree.frontal_dim[c] * total * total;
    ++result.merged[k];
  }
}

// Frontals, separators and rows. Separators lie on a way to the root, on which renumbering changes no order. A row is
// assembled where its first variable is eliminated.
void list_variables(const elim::CliqueLists& tree, const graph::Order& order,
                    const std::vector<Index>& target, const std::vector<Index>& clique,
                    CliqueTree& result) {
  std::vector<Index> clique_at(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) clique_at[k] = clique[tree.clique[k]];
  result.frontals = graph::grouped(clique_at, result.cliques());
  for (Index& p : result.frontals.items) p = order[p];

  std::vector<Index> kept(result.cliques());
  std::size_t items = 0;
  for (Index c = 0; c < tree.cliques(); ++c) {
    if (target[c] != c) continue;
    kept[clique[c]] = c;
    items += tree.separator(c).size();
  }
  result.separators.begin.reserve(kept.size() + 1);
  result.separators.items.reserve(items);
  for (Index c : kept) {
    for (Index p : tree.separator(c)) result.separators.items.push_back(order[p]);
    result.separators.close();
  }

  result.row_clique.resize(tree.row_first.size());
  std::ranges::transform(tree.row_first, result.row_clique.begin(),
                         [&](Index first) { return first < 0 ? -1 : clique_at[first]; });
}

}  // namespace

std::vector<bool> childless(std::span<const Index> parent) {
  std::vector<bool> result(parent.size(), true);
  for (const Index p : parent) {
    if (p >= 0) result[p] = false;
  }
  return result;
}

CliqueTree clique_tree(const graph::Pattern& pattern, const graph::Order& order, int relaxed_from) {
  const elim::CliqueLists tree = elim::clique_lists(pattern, order);
  std::vector<Index> target(tree.cliques());
  std::iota(target.begin(), target.end(), 0);
  if (relaxed_from < never) merge_into_parents(tree, relaxed_from, target);

  CliqueTree result;
  const std::vector<Index> clique = number_cliques(tree, target, result);
  sum_up(tree, clique, target, result);
  list_variables(tree, order, target, clique, result);
  assert(graph::is_permutation(result.frontals.items, pattern.variables()));
  return result;
}

}  // namespace sg::solve
