#include "lib/elim/etree.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>

namespace sg::elim {
namespace {

// Whether every vertex comes before its parent.
[[maybe_unused]] bool is_forest(const std::vector<Index>& parent) {
  const auto n = static_cast<Index>(parent.size());
  for (Index k = 0; k < n; ++k) {
    if (parent[k] != -1 && (parent[k] <= k || parent[k] >= n)) return false;
  }
  return true;
}

}  // namespace

std::vector<Index> positions(const graph::Order& order, Index n) {
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

OrderedPattern ordered(const graph::Pattern& pattern, const graph::Order& order) {
  const Index n = pattern.variables();
  const std::vector<Index> position = positions(order, n);
  OrderedPattern result;
  result.dim.resize(n);
  for (Index k = 0; k < n; ++k) result.dim[k] = pattern.dim[order[k]];

  std::vector<Index> first(pattern.rows.size(), -1);  // position of every row
  for (Index r = 0; r < pattern.rows.size(); ++r) {
    for (Index j : pattern.rows[r]) {
      if (first[r] < 0 || position[j] < first[r]) first[r] = position[j];
    }
  }
  const graph::Lists<> by_first = graph::grouped(first, n);
  result.rows.begin.reserve(by_first.items.size() + 1);
  result.rows.items.reserve(pattern.rows.items.size());
  for (Index r : by_first.items) {
    for (Index j : pattern.rows[r]) result.rows.items.push_back(position[j]);
    std::ranges::sort(result.rows.open());
    result.rows.close();
  }
  return result;
}

namespace {

// The edges of one row.
void add_links(std::span<const Index> row, const auto& position, std::vector<Link>& list) {
  if (row.size() < 2) return;
  if (row.size() == 2) {  // nearly always, and quicker without branches
    const Index a = position(row[0]);
    const Index b = position(row[1]);
    list.push_back({std::min(a, b), std::max(a, b)});
    return;
  }
  Index first = position(row[0]);
  for (const Index j : row.subspan(1)) first = std::min(first, position(j));
  for (const Index j : row) {
    if (position(j) != first) list.push_back({first, position(j)});
  }
}

Links links_of(const auto& pattern, const auto& position) {
  std::vector<Link> list;
  list.reserve(pattern.rows.size());
  for (Index r = 0; r < pattern.rows.size(); ++r) add_links(pattern.rows[r], position, list);
  const Index n = pattern.variables();
  return {n, graph::counting_sort<Link>(n, [&](const auto& put) {
               for (const Link& link : list) put(link.upper, link);
             }).items};
}

}  // namespace

Links links(const graph::Pattern& pattern, const graph::Order& order) {
  const std::vector<Index> position = positions(order, pattern.variables());
  return links_of(pattern, [&](Index j) { return position[j]; });
}

Links links(const OrderedPattern& pattern) {
  return links_of(pattern, [](Index k) { return k; });
}

std::vector<Index> elimination_tree(const Links& links) {
  assert(std::ranges::is_sorted(links.list, {}, &Link::upper));
  assert(std::ranges::all_of(links.list, [&](const Link& link) {
    return 0 <= link.lower && link.lower < link.upper && link.upper < links.size;
  }));
  std::vector<Index> parent(links.size, -1);
  std::vector<Index> ancestor(links.size, -1);
  for (const Link& link : links.list) {
    // Up to the root of the lower end's tree, which becomes a child of the upper end.
    const Index k = link.upper;
    for (Index i = link.lower; ancestor[i] != k;) {
      const Index next = ancestor[i];
      ancestor[i] = k;  // path compression
      if (next == -1) {
        parent[i] = k;
        break;
      }
      i = next;
    }
  }
  return parent;
}

std::vector<Index> subtree_sizes(const std::vector<Index>& parent) {
  assert(is_forest(parent));
  std::vector<Index> size(parent.size(), 1);
  for (std::size_t k = 0; k < parent.size(); ++k) {
    if (parent[k] >= 0) size[parent[k]] += size[k];
  }
  return size;
}

std::vector<Index> postorder_ranks(const std::vector<Index>& parent,
                                   const std::vector<Index>& size) {
  assert(is_forest(parent) && size.size() == parent.size());
  // From the last root down, every vertex takes the last free place of its parent's subtree.
  std::vector<Index> rank(parent.size());
  std::vector<Index> free_end(parent.size());  // of every vertex's subtree
  auto forest_end = static_cast<Index>(parent.size());
  for (auto k = static_cast<Index>(parent.size()) - 1; k >= 0; --k) {
    Index& end = parent[k] >= 0 ? free_end[parent[k]] : forest_end;
    rank[k] = free_end[k] = end - 1;
    end -= size[k];
  }
  return rank;
}

std::vector<Index> postorder(const std::vector<Index>& parent) {
  const std::vector<Index> rank = postorder_ranks(parent, subtree_sizes(parent));
  std::vector<Index> post(parent.size());
  for (std::size_t k = 0; k < parent.size(); ++k) post[rank[k]] = static_cast<Index>(k);
  return post;
}

Index height(const std::vector<Index>& parent) {
  assert(is_forest(parent));
  std::vector<Index> depth(parent.size(), 1);
  Index deepest = 0;
  for (auto k = static_cast<Index>(parent.size()) - 1; k >= 0; --k) {
    if (parent[k] >= 0) depth[k] = depth[parent[k]] + 1;
    deepest = std::max(deepest, depth[k]);
  }
  return deepest;
}

}  // namespace sg::elim
