#include "lib/elim/counts.h"

#include <cassert>

namespace sg::elim {
namespace {

// All that the counting looks at, in postorder: neighbours in the tree are then neighbours in
// memory. Places count from 1. The parent of roots is place n + 1, and place 0 stands for "none":
// treating both like any other spares branches, and what gathers there nobody reads.
struct Postordered {
  std::vector<Index> place;   // of every position
  std::vector<Index> parent;  // n + 2, as the next two
  std::vector<Index> first;   // first descendant
  std::vector<int> dim;
  std::vector<Link> links;  // by ascending lower end
};

Postordered postordered(const Links& links, const std::vector<int>& dim,
                        const std::vector<Index>& parent) {
  const Index n = links.size;
  const std::vector<Index> size = subtree_sizes(parent);
  Postordered post{postorder_ranks(parent, size),
                   std::vector<Index>(n + 2, n + 1),
                   std::vector<Index>(n + 2, 0),
                   std::vector<int>(n + 2, 0),
                   {}};
  std::vector<Index>& place = post.place;
  for (Index& k : place) ++k;
  for (Index k = 0; k < n; ++k) {
    const Index j = place[k];
    if (parent[k] >= 0) post.parent[j] = place[parent[k]];
    post.first[j] = j - size[k] + 1;
    post.dim[j] = dim[k];
  }
  post.links = graph::counting_sort<Link>(n + 1, [&](const auto& put) {
                 for (const Link& link : links.list) {
                   put(place[link.lower], Link{place[link.lower], place[link.upper]});
                 }
               }).items;
  return post;
}

// The first ancestor of i, or i itself, that is not before j: where i < j lie in one tree, their
// least common ancestor. Jumps only skip what lies before j, and later j are larger, so that paths
// may be halved on the way.
Index ancestor_from(std::vector<Index>& jump, Index i, Index j) {
  while (i < j) {
    const Index up = jump[i];
    if (up >= j) return up;
    i = jump[i] = jump[up];
  }
  return i;
}

// The counts as sums over subtrees: what every vertex adds to them. A row subtree weighs its root's
// dimension: it begins at each of its leaves, two of its branches become one where they meet, and
// it ends above its root.
std::vector<std::int64_t> count_differences(const Postordered& post) {
  const auto n = static_cast<Index>(post.place.size());
  std::vector<std::int64_t> delta(n + 2, 0);
  for (Index j = 1; j <= n; ++j) {
    if (post.first[j] == j) delta[j] += post.dim[j];  // a leaf of the tree is all of its subtree
    delta[post.parent[j]] -= post.dim[j];
  }
  std::vector<Index> jump = post.parent;
  std::vector<Index> previous_leaf(n + 2, 0);  // of the row subtree whose root it is
  for (const auto& [j, i] : post.links) {
    const Index previous = previous_leaf[i];
    if (post.first[j] <= previous) continue;  // i's subtree has a leaf below j
    previous_leaf[i] = j;
    delta[j] += post.dim[i];
    delta[ancestor_from(jump, previous, j)] -= post.dim[i];
  }
  return delta;
}

}  // namespace

std::vector<std::int64_t> column_counts(const Links& links, const std::vector<int>& dim,
                                        const std::vector<Index>& parent) {
  assert(dim.size() == parent.size() && static_cast<Index>(dim.size()) == links.size);
  const Postordered post = postordered(links, dim, parent);
  std::vector<std::int64_t> sum = count_differences(post);
  for (std::size_t j = 1; j <= post.place.size(); ++j) sum[post.parent[j]] += sum[j];
  std::vector<std::int64_t> count(dim.size());
  for (std::size_t k = 0; k < count.size(); ++k) count[k] = sum[post.place[k]];
  return count;
}

}  // namespace sg::elim
