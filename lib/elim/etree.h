// The elimination tree of A^T A, straight from the rows of A.
//
// Eliminating variables in an order, the parent of a variable is the first of its separator to be
// eliminated after it (Liu, The role of elimination trees in sparse factorization, 1990). The tree
// is computed from the factors without forming A^T A (Davis, Direct Methods for Sparse Linear
// Systems, 2006, section 4.1 and 4.7), in near-linear time.
//
// Here and in all of lib/elim, variables are called by their *position* in the order: 0 is
// eliminated first.
#pragma once

#include <vector>

#include "lib/graph/pattern.h"

namespace sg::elim {

// The position of every variable. Throws std::invalid_argument if `order` is no permutation of 0 .. n - 1.
std::vector<Index> positions(const graph::Order& order, Index n);

// The pattern with variables renumbered by position: variable order[k] becomes k. Rows hold
// ascending positions, and the rows are grouped by the position of their first variable (Davis's
// "head/next" lists, laid flat).
struct OrderedPattern {
  std::vector<int> dim;  // n
  graph::Lists<> rows;   // those with at least one variable
  Index variables() const { return static_cast<Index>(dim.size()); }
};
// Throws std::invalid_argument if `order` is not a permutation of the pattern's variables.
OrderedPattern ordered(const graph::Pattern& pattern, const graph::Order& order);

// What tree and counts need of the rows: for every row of A, an edge from its first position to
// each of its others. Eliminating the first joins the others anyhow, so that this graph, which is
// no larger than A, has the tree and the fill of A^T A.
struct Link {
  Index lower;
  Index upper;  // > lower
};
struct Links {
  Index size;              // n
  std::vector<Link> list;  // by ascending upper end
};
// Throws as ordered() does, which is the slower way to the same.
Links links(const graph::Pattern& pattern, const graph::Order& order);
Links links(const OrderedPattern& pattern);

// parent[k] of every position, -1 at a root.
std::vector<Index> elimination_tree(const Links& links);
inline std::vector<Index> elimination_tree(const OrderedPattern& pattern) {
  return elimination_tree(links(pattern));
}

// A postorder of the forest: children before parents, subtrees contiguous, siblings ascending, and
// so roots. parent[k] > k is required.
std::vector<Index> postorder(const std::vector<Index>& parent);
// Its inverse, the place of every position, from subtree_sizes.
std::vector<Index> postorder_ranks(const std::vector<Index>& parent,
                                   const std::vector<Index>& size);
// Vertices in the subtree of every position, itself included.
std::vector<Index> subtree_sizes(const std::vector<Index>& parent);

// Depth of the deepest vertex, counted in vertices; 0 for the empty tree. parent[k] > k is
// required.
Index height(const std::vector<Index>& parent);

}  // namespace sg::elim
