#include "lib/elim/etree.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace sg {
namespace {

std::vector<Index> positions(const Order& order, Index n) {
  std::vector<Index> position(n, -1);
  if (static_cast<Index>(order.size()) != n)
    throw std::invalid_argument("the order has the wrong length");
  for (Index k = 0; k < n; ++k) {
    if (order[k] < 0 || order[k] >= n || position[order[k]] >= 0) {
      throw std::invalid_argument("the order is not a permutation");
    }
    position[order[k]] = k;
  }
  return position;
}

}  // namespace

OrderedPattern ordered(const Pattern& pattern, const Order& order) {
  const Index n = pattern.variables();
  const std::vector<Index> position = positions(order, n);
  OrderedPattern result;
  result.dim.resize(n);
  for (Index k = 0; k < n; ++k) result.dim[k] = pattern.dim[order[k]];

  // Counting sort of the rows by their first position.
  std::vector<Index> first(pattern.rows());
  std::vector<Index> at(n + 2, 0);
  Index kept = 0;
  for (Index r = 0; r < pattern.rows(); ++r) {
    first[r] = n;
    for (Index j : pattern.row(r)) first[r] = std::min(first[r], position[j]);
    ++at[first[r] + 1];
    kept += first[r] < n;
  }
  std::partial_sum(at.begin(), at.end(), at.begin());
  std::vector<Index> sorted(pattern.rows());
  for (Index r = 0; r < pattern.rows(); ++r) sorted[at[first[r]]++] = r;

  result.row_begin.reserve(kept + 1);
  result.row_begin.push_back(0);
  result.row_positions.reserve(pattern.row_variables.size());
  for (Index s = 0; s < kept; ++s) {
    const auto begin = static_cast<std::ptrdiff_t>(result.row_positions.size());
    for (Index j : pattern.row(sorted[s])) result.row_positions.push_back(position[j]);
    std::sort(result.row_positions.begin() + begin, result.row_positions.end());
    result.row_begin.push_back(static_cast<Index>(result.row_positions.size()));
  }
  return result;
}

std::vector<Index> elimination_tree(const OrderedPattern& pattern) {
  // A row is a clique. Its variables lie on one path of the tree, so linking each to the next one
  // is enough; and a row counts from its first variable on, in which order the rows stand.
  // Processing columns ascending, as Liu does, wants for every column the links that end in it:
  // (lower, column) pairs, bucketed by column.
  const Index n = pattern.variables();
  std::vector<Index> begin(n + 1, 0);
  for (Index r = 0; r < pattern.rows(); ++r) {
    for (Index k : pattern.row(r).subspan(1)) ++begin[k + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Index> lower(begin.back());
  {
    std::vector<Index> at(begin.begin(), begin.end() - 1);
    for (Index r = 0; r < pattern.rows(); ++r) {
      const auto row = pattern.row(r);
      for (std::size_t i = 1; i < row.size(); ++i) lower[at[row[i]]++] = row[i - 1];
    }
  }
  std::vector<Index> parent(n, -1);
  std::vector<Index> ancestor(n, -1);
  for (Index k = 0; k < n; ++k) {
    for (Index p = begin[k]; p < begin[k + 1]; ++p) {
      for (Index i = lower[p]; i != -1 && i < k;) {
        const Index next = ancestor[i];
        ancestor[i] = k;  // path compression
        if (next == -1) parent[i] = k;
        i = next;
      }
    }
  }
  return parent;
}

std::vector<Index> postorder(const std::vector<Index>& parent) {
  const auto n = static_cast<Index>(parent.size());
  std::vector<Index> head(n, -1);
  std::vector<Index> next(n, -1);
  for (Index k = n - 1; k >= 0; --k) {
    if (parent[k] < 0) continue;
    next[k] = head[parent[k]];
    head[parent[k]] = k;
  }
  std::vector<Index> post;
  post.reserve(n);
  std::vector<Index> stack;
  for (Index root = 0; root < n; ++root) {
    if (parent[root] >= 0) continue;
    stack.push_back(root);
    while (!stack.empty()) {
      const Index k = stack.back();
      if (head[k] >= 0) {
        stack.push_back(head[k]);
        head[k] = next[head[k]];
      } else {
        post.push_back(k);
        stack.pop_back();
      }
    }
  }
  return post;
}

Index height(const std::vector<Index>& parent) {
  std::vector<Index> depth(parent.size(), 1);
  Index deepest = 0;
  for (auto k = static_cast<Index>(parent.size()) - 1; k >= 0; --k) {
    if (parent[k] >= 0) depth[k] = depth[parent[k]] + 1;
    deepest = std::max(deepest, depth[k]);
  }
  return deepest;
}

}  // namespace sg
