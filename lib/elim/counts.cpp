#include "lib/elim/counts.h"

#include <numeric>
#include <span>

namespace sg {
namespace {

// Least common ancestors of consecutive leaves of a row subtree, as the skeleton algorithm meets
// them (Davis, 4.4).
struct RowSubtrees {
  std::vector<Index> ancestor;  // disjoint sets with path compression
  std::vector<Index> previous_leaf;
  std::vector<Index> max_first;

  explicit RowSubtrees(Index n) : ancestor(n), previous_leaf(n, -1), max_first(n, -1) {
    std::iota(ancestor.begin(), ancestor.end(), 0);
  }

  Index find(Index k) {
    Index root = k;
    while (root != ancestor[root]) root = ancestor[root];
    while (k != root) {
      const Index next = ancestor[k];
      ancestor[k] = root;
      k = next;
    }
    return root;
  }
};

// First descendant (in postorder) of every position, by postorder number.
std::vector<Index> first_descendants(const std::vector<Index>& post,
                                     const std::vector<Index>& parent) {
  std::vector<Index> first(post.size(), -1);
  for (Index k = 0; k < static_cast<Index>(post.size()); ++k) {
    for (Index j = post[k]; j != -1 && first[j] == -1; j = parent[j]) first[j] = k;
  }
  return first;
}

}  // namespace

std::vector<std::int64_t> column_counts(const OrderedPattern& pattern,
                                        const std::vector<Index>& parent) {
  const Index n = pattern.variables();
  const std::vector<Index> post = postorder(parent);
  const std::vector<Index> first = first_descendants(post, parent);
  std::vector<std::int64_t> count(n, 0);
  for (Index k = 0; k < n; ++k) {
    if (first[post[k]] == k) count[post[k]] = pattern.dim[post[k]];  // a leaf of the tree
  }
  // Rows by their first position: they are sorted by it.
  std::vector<Index> row_of(n + 1, 0);
  for (Index r = 0; r < pattern.rows(); ++r) ++row_of[pattern.row(r).front() + 1];
  std::partial_sum(row_of.begin(), row_of.end(), row_of.begin());

  RowSubtrees subtrees(n);
  for (Index j : post) {
    if (parent[j] != -1) count[parent[j]] -= pattern.dim[j];
    for (Index r = row_of[j]; r < row_of[j + 1]; ++r) {
      for (Index i : pattern.row(r).subspan(1)) {
        if (first[j] <= subtrees.max_first[i]) continue;  // j is no leaf of row i's subtree
        subtrees.max_first[i] = first[j];
        count[j] += pattern.dim[i];
        const Index previous = subtrees.previous_leaf[i];
        subtrees.previous_leaf[i] = j;
        if (previous != -1) count[subtrees.find(previous)] -= pattern.dim[i];
      }
    }
    if (parent[j] != -1) subtrees.ancestor[j] = parent[j];
  }
  for (Index k = 0; k < n; ++k) {
    if (parent[k] != -1) count[parent[k]] += count[k];
  }
  return count;
}

}  // namespace sg
