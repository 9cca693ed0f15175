#include "lib/elim/counts.h"

#include <numeric>
#include <span>

namespace sg {
namespace {

// All that the counting looks at, in postorder: neighbours in the tree are then neighbours in
// memory. Places count from 1; place 0 is the parent of roots, and what comes of its being treated
// like any other, which spares the branches, nobody reads.
struct Postordered {
  std::vector<Index> place;   // of every position
  std::vector<Index> parent;  // n + 1, as all below
  std::vector<Index> first;   // first descendant
  std::vector<int> dim;
  std::vector<Index> begin;  // n + 2
  std::vector<Index> upper;  // the upper ends of the links whose lower end is j, by j
};

Postordered postordered(const Links& links, const std::vector<int>& dim,
                        const std::vector<Index>& parent) {
  const Index n = links.size();
  const std::vector<Index> size = subtree_sizes(parent);
  Postordered post{postorder_ranks(parent, size), std::vector<Index>(n + 1, 0),
                   std::vector<Index>(n + 1, 0),  std::vector<int>(n + 1, 0),
                   std::vector<Index>(n + 2, 0),  std::vector<Index>(links.lower.size())};
  std::vector<Index>& place = post.place;
  for (Index& k : place) ++k;
  for (Index k = 0; k < n; ++k) {
    const Index j = place[k];
    post.parent[j] = parent[k] < 0 ? 0 : place[parent[k]];
    post.first[j] = j - size[k] + 1;
    post.dim[j] = dim[k];
  }
  for (const Index i : links.lower) ++post.begin[place[i] + 1];
  std::partial_sum(post.begin.begin(), post.begin.end(), post.begin.begin());
  std::vector<Index> at(post.begin.begin(), post.begin.end() - 1);
  for (Index k = 0; k < n; ++k) {
    for (const Index i : links[k]) post.upper[at[place[i]]++] = place[k];
  }
  return post;
}

// The root of i's set; disjoint sets, paths halved on the way.
Index find(std::vector<Index>& ancestor, Index i) {
  while (ancestor[i] != i) {
    ancestor[i] = ancestor[ancestor[i]];
    i = ancestor[i];
  }
  return i;
}

// The counts as sums over subtrees: what every vertex adds to them. A row subtree weighs its root's
// dimension: it begins at each of its leaves, two of its branches become one where they meet, and
// it ends above its root.
std::vector<std::int64_t> count_differences(const Postordered& post) {
  const auto places = static_cast<Index>(post.parent.size());
  std::vector<std::int64_t> delta(places, 0);
  std::vector<Index> ancestor(places);
  std::iota(ancestor.begin(), ancestor.end(), 0);
  std::vector<Index> previous_leaf(places, 0);  // of the row subtree whose root it is
  for (Index j = 1; j < places; ++j) {
    if (post.first[j] == j) delta[j] += post.dim[j];  // a leaf of the tree is all of its subtree
    for (Index p = post.begin[j]; p < post.begin[j + 1]; ++p) {
      const Index i = post.upper[p];
      const Index previous = previous_leaf[i];
      if (post.first[j] <= previous) continue;  // i's subtree has a leaf below j
      previous_leaf[i] = j;
      delta[j] += post.dim[i];
      delta[find(ancestor, previous)] -= post.dim[i];
    }
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
  for (std::size_t j = 1; j < sum.size(); ++j) sum[post.parent[j]] += sum[j];
  std::vector<std::int64_t> count(dim.size());
  for (std::size_t k = 0; k < count.size(); ++k) count[k] = sum[post.place[k]];
  return count;
}

}  // namespace sg
