#include "lib/elim/counts.h"

#include <numeric>
#include <span>

namespace sg {
namespace {

// All that the counting looks at, in postorder: neighbours in the tree are then neighbours in
// memory.
struct Postordered {
  std::vector<Index> rank;  // by position; all below is by rank
  std::vector<Index> parent;
  std::vector<Index> first;  // first descendant
  std::vector<int> dim;
  std::vector<Index> begin;  // n + 1
  std::vector<Index> upper;  // the upper ends of the links whose lower end is j, by j
};

Postordered postordered(const Links& links, const std::vector<int>& dim,
                        const std::vector<Index>& parent) {
  const Index n = links.size();
  const std::vector<Index> size = subtree_sizes(parent);
  Postordered post{postorder_ranks(parent, size), std::vector<Index>(n),
                   std::vector<Index>(n),         std::vector<int>(n),
                   std::vector<Index>(n + 1, 0),  std::vector<Index>(links.lower.size())};
  const std::vector<Index>& rank = post.rank;
  for (Index k = 0; k < n; ++k) {
    post.parent[rank[k]] = parent[k] < 0 ? -1 : rank[parent[k]];
    post.first[rank[k]] = rank[k] - size[k] + 1;
    post.dim[rank[k]] = dim[k];
  }
  for (const Index i : links.lower) ++post.begin[rank[i] + 1];
  std::partial_sum(post.begin.begin(), post.begin.end(), post.begin.begin());
  std::vector<Index> at(post.begin.begin(), post.begin.end() - 1);
  for (Index k = 0; k < n; ++k) {
    for (const Index i : links[k]) post.upper[at[rank[i]]++] = rank[k];
  }
  return post;
}

// The root of i's set; disjoint sets with path compression.
Index find(std::vector<Index>& ancestor, Index i) {
  Index root = i;
  while (root != ancestor[root]) root = ancestor[root];
  while (i != root) {
    const Index next = ancestor[i];
    ancestor[i] = root;
    i = next;
  }
  return root;
}

// The counts as sums over subtrees: what every vertex adds to them. A row subtree weighs its root's
// dimension: it begins at each of its leaves, two of its branches become one where they meet, and
// it ends above its root.
std::vector<std::int64_t> count_differences(const Postordered& post) {
  const auto n = static_cast<Index>(post.parent.size());
  std::vector<std::int64_t> delta(n, 0);
  std::vector<Index> ancestor(n);
  std::iota(ancestor.begin(), ancestor.end(), 0);
  std::vector<Index> previous_leaf(n, -1);  // of the row subtree whose root it is
  for (Index j = 0; j < n; ++j) {
    if (post.first[j] == j) delta[j] += post.dim[j];  // a leaf of the tree is all of its subtree
    for (Index p = post.begin[j]; p < post.begin[j + 1]; ++p) {
      const Index i = post.upper[p];
      const Index previous = previous_leaf[i];
      if (post.first[j] <= previous) continue;  // i's subtree has a leaf below j
      previous_leaf[i] = j;
      delta[j] += post.dim[i];
      if (previous != -1) delta[find(ancestor, previous)] -= post.dim[i];
    }
    if (post.parent[j] < 0) continue;
    delta[post.parent[j]] -= post.dim[j];
    ancestor[j] = post.parent[j];
  }
  return delta;
}

}  // namespace

std::vector<std::int64_t> column_counts(const Links& links, const std::vector<int>& dim,
                                        const std::vector<Index>& parent) {
  const Postordered post = postordered(links, dim, parent);
  std::vector<std::int64_t> sum = count_differences(post);
  for (std::size_t j = 0; j < sum.size(); ++j) {
    if (post.parent[j] >= 0) sum[post.parent[j]] += sum[j];
  }
  std::vector<std::int64_t> count(sum.size());
  for (std::size_t k = 0; k < sum.size(); ++k) count[k] = sum[post.rank[k]];
  return count;
}

}  // namespace sg
