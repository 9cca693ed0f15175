#include "lib/solve/clique_tree.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "lib/elim/bayes_tree.h"
#include "lib/elim/counts.h"
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
void merge_into_parents(const elim::BayesTree& tree, std::vector<Index>& target) {
  const Index cliques = tree.cliques();
  std::vector<double> f(tree.frontal_dim.begin(), tree.frontal_dim.end());
  std::vector<double> n(tree.total_dim.begin(), tree.total_dim.end());
  for (double& rows : n) ++rows;  // the right-hand side
  const std::vector<bool> leaf = childless(tree.parent);
  // Parents come before their children, so that a clique is complete when its own turn comes.
  for (Index c = cliques - 1; c >= 0; --c) {
    const Index p = tree.parent[c];
    if (p < 0) continue;
    const bool factor =
        leaf[c] && stays_factor(static_cast<int>(f[c]), static_cast<int>(n[c] - f[c]) - 1);
    const double passage = 0.5 * (n[c] - f[c]) * (n[c] - f[c]);
    const double own = factor ? leaf_time(f[c], n[c]) : front_time(f[c], n[c]) + passage;
    if (front_time(f[c] + f[p], f[c] + n[p]) > own + front_time(f[p], n[p])) continue;
    target[c] = p;
    f[p] += f[c];
    n[p] += f[c];
  }
  for (Index c = 0; c < cliques; ++c) target[c] = target[target[c]];
}

// Numbers the merged cliques in postorder: of every clique of the Bayes tree the number of the one
// that it is part of. Fills in the parents.
std::vector<Index> number_cliques(const elim::BayesTree& tree, const std::vector<Index>& target,
                                  CliqueTree& result) {
  std::vector<Index> rank(tree.cliques(), -1);  // among those that stay, children before parents
  std::vector<Index> kept;
  for (Index c = tree.cliques() - 1; c >= 0; --c) {
    if (target[c] != c) continue;
    rank[c] = static_cast<Index>(kept.size());
    kept.push_back(c);
  }
  std::vector<Index> parent(kept.size());
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const Index p = tree.parent[kept[k]];
    parent[k] = p < 0 ? -1 : rank[target[p]];
  }
  const std::vector<Index> post = elim::postorder(parent);
  std::vector<Index> number(post.size());
  for (Index k = 0; k < static_cast<Index>(post.size()); ++k) number[post[k]] = k;
  result.parent.resize(post.size());
  for (Index k = 0; k < static_cast<Index>(post.size()); ++k)
    result.parent[k] = parent[post[k]] < 0 ? -1 : number[parent[post[k]]];

  std::vector<Index> clique(tree.cliques());
  for (Index c = 0; c < tree.cliques(); ++c) clique[c] = number[rank[target[c]]];
  return clique;
}

// Dimensions, and what the Bayes tree's own cliques cost.
void sum_up(const elim::BayesTree& tree, const std::vector<Index>& clique,
            const std::vector<Index>& target, CliqueTree& result) {
  const auto cliques = result.parent.size();
  result.frontal_dim.assign(cliques, 0);
  result.separator_dim.assign(cliques, 0);
  result.ec.assign(cliques, 0);
  for (Index c = 0; c < tree.cliques(); ++c) {
    const Index k = clique[c];
    result.frontal_dim[k] += static_cast<int>(tree.frontal_dim[c]);
    if (target[c] == c)
      result.separator_dim[k] = static_cast<int>(tree.total_dim[c] - tree.frontal_dim[c]);
    result.ec[k] += tree.frontal_dim[c] * tree.total_dim[c] * tree.total_dim[c];
  }
}

// Frontals and separators as variables, in elimination order.
void list_variables(const elim::BayesTree& tree, const graph::Order& order,
                    const std::vector<Index>& target, const std::vector<Index>& clique,
                    const graph::Lists<>& separator_positions, CliqueTree& result) {
  const auto n = static_cast<Index>(order.size());
  std::vector<Index> clique_at(n);
  for (Index k = 0; k < n; ++k) clique_at[k] = clique[tree.clique[k]];
  result.frontals = graph::grouped(clique_at, result.cliques());
  std::vector<Index>& frontals = result.frontals.items;
  std::vector<Index> rank(n);  // of a position in the new order
  for (Index k = 0; k < n; ++k) rank[frontals[k]] = k;

  std::vector<Index> kept(result.cliques());
  for (Index c = 0; c < tree.cliques(); ++c) {
    if (target[c] == c) kept[clique[c]] = c;
  }
  for (Index c : kept) {
    for (Index p : separator_positions[c]) result.separators.items.push_back(rank[p]);
    std::ranges::sort(result.separators.open());
    result.separators.close();
  }
  for (Index& p : frontals) p = order[p];
  for (Index& k : result.separators.items) k = frontals[k];
}

// A row is assembled where its first variable is eliminated.
void place_rows(const graph::Pattern& pattern, CliqueTree& result) {
  std::vector<Index> rank(pattern.variables());
  std::vector<Index> clique(pattern.variables());
  for (Index c = 0, position = 0; c < result.cliques(); ++c) {
    for (Index j : result.frontals[c]) {
      rank[j] = position++;
      clique[j] = c;
    }
  }
  result.row_clique.resize(pattern.rows.size());
  for (Index r = 0; r < pattern.rows.size(); ++r) {
    Index first = -1;
    for (Index j : pattern.rows[r]) {
      if (first < 0 || rank[j] < rank[first]) first = j;
    }
    result.row_clique[r] = first < 0 ? -1 : clique[first];
  }
}

}  // namespace

std::vector<bool> childless(std::span<const Index> parent) {
  std::vector<bool> result(parent.size(), true);
  for (const Index p : parent) {
    if (p >= 0) result[p] = false;
  }
  return result;
}

CliqueOutline clique_outline(const elim::BayesTree& tree, bool relaxed) {
  CliqueOutline result;
  result.target.resize(tree.cliques());
  std::iota(result.target.begin(), result.target.end(), 0);
  if (relaxed) merge_into_parents(tree, result.target);
  result.clique = number_cliques(tree, result.target, result.tree);
  sum_up(tree, result.clique, result.target, result.tree);
  return result;
}

CliqueTree clique_tree(const graph::Pattern& pattern, const graph::Order& order, bool relaxed) {
  const elim::OrderedPattern by_position = elim::ordered(pattern, order);
  elim::Symbolic symbolic{by_position.dim, elim::elimination_tree(by_position), {}};
  symbolic.count = elim::column_counts(by_position, symbolic.parent);
  const elim::BayesTree tree = elim::bayes_tree(symbolic);
  CliqueOutline cliques = clique_outline(tree, relaxed);
  list_variables(tree, order, cliques.target, cliques.clique,
                 elim::clique_separators(by_position, tree), cliques.tree);
  place_rows(pattern, cliques.tree);
  assert(graph::is_permutation(cliques.tree.frontals.items, pattern.variables()));
  return std::move(cliques.tree);
}

}  // namespace sg::solve
