#include "lib/order/region.h"

#include <algorithm>
#include <cassert>
#include <queue>
#include <utility>

#include "lib/elim/counts.h"

namespace sg::order {
namespace {

// The first position of every subtree.
std::vector<Index> subtree_begin(const std::vector<Index>& parent) {
  std::vector<Index> first(parent.size());
  for (Index k = 0; k < static_cast<Index>(parent.size()); ++k) first[k] = k;
  for (Index k = 0; k < static_cast<Index>(parent.size()); ++k) {
    if (parent[k] >= 0) first[parent[k]] = std::min(first[parent[k]], first[k]);
  }
  return first;
}

// Children of k in a postorder, by way of their subtrees: the last is k - 1.
template <class Function>
void for_children(const OrderedElimination& e, Index k, Function function) {
  for (Index child = k - 1; child >= e.first[k]; child = e.first[child] - 1) function(child);
}

std::vector<Index> top_of_subtree(const OrderedElimination& e, Index root, Index size) {
  std::vector<Index> inside;
  std::priority_queue<std::pair<std::int64_t, Index>> next;
  next.emplace(e.count[root], root);
  while (!next.empty() && static_cast<Index>(inside.size()) < size) {
    const Index k = next.top().second;
    next.pop();
    inside.push_back(k);
    for_children(e, k, [&](Index child) { next.emplace(e.count[child], child); });
  }
  std::sort(inside.begin(), inside.end());
  return inside;
}

// The first row whose first variable is at this position or later.
Index first_row(const OrderedElimination& e, Index position) {
  Index low = 0, high = e.pattern.rows.size();
  while (low < high) {
    const Index middle = low + (high - low) / 2;
    if (e.pattern.rows[middle][0] < position) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}

// Closes a row, its positions once each; one without any is none.
void end_row(graph::Lists<>& rows) {
  std::ranges::sort(rows.open());
  const auto row = rows.open();
  rows.items.resize(rows.items.size() - std::ranges::unique(row).size());
  if (!rows.open().empty()) rows.close();
}

// The rows of R, in positions: those that R eliminates, and the separators of what hangs below it.
graph::Lists<> region_rows(const OrderedElimination& e, const std::vector<Index>& inside) {
  graph::Lists<> rows;
  const auto hanging = [&](Index child) {
    if (std::binary_search(inside.begin(), inside.end(), child)) return;
    for (Index r = first_row(e, e.first[child]), end = first_row(e, child + 1); r < end; ++r) {
      for (Index k : e.pattern.rows[r]) {
        if (k > child) rows.items.push_back(k);
      }
    }
    end_row(rows);
  };
  for (Index k : inside) {
    for (Index r = first_row(e, k); r < e.pattern.rows.size() && e.pattern.rows[r][0] == k; ++r) {
      rows.add(e.pattern.rows[r]);
    }
    for_children(e, k, hanging);
  }
  return rows;
}

}  // namespace

OrderedElimination elimination(const graph::Pattern& pattern, const graph::Order& order) {
  const std::vector<Index> post =
      elim::postorder(elim::elimination_tree(elim::ordered(pattern, order)));
  OrderedElimination e;
  e.order.reserve(order.size());
  for (Index k : post) e.order.push_back(order[k]);
  e.pattern = elim::ordered(pattern, e.order);
  e.parent = elim::elimination_tree(e.pattern);
  e.first = subtree_begin(e.parent);
  e.count = elim::column_counts(e.pattern, e.parent);
  for (std::size_t k = 0; k < e.count.size(); ++k) {
    e.ec += elim::elimination_cost(e.pattern.dim[k], e.count[k]);
  }
  return e;
}

Region region(const OrderedElimination& e, Index root, Index size) {
  assert(0 <= root && root < static_cast<Index>(e.parent.size()) && size > 0);
  Region result{root, top_of_subtree(e, root, size), {}, 0};
  graph::Lists<>& rows = result.pattern.rows;
  rows = region_rows(e, result.inside);
  std::vector<Index> positions = result.inside;
  positions.insert(positions.end(), rows.items.begin(), rows.items.end());
  std::sort(positions.begin(), positions.end());
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
  for (Index k : positions) result.pattern.dim.push_back(e.pattern.dim[k]);
  for (Index& k : rows.items) {
    const auto at = std::lower_bound(positions.begin(), positions.end(), k);
    k = static_cast<Index>(at - positions.begin());
  }
  for (Index k : result.inside) result.ec += elim::elimination_cost(e.pattern.dim[k], e.count[k]);
  return result;
}

elim::Wide region_ec(const Region& region, const graph::Order& order) {
  const elim::Symbolic after = elim::symbolic(region.pattern, order);
  elim::Wide ec = 0;
  for (std::size_t k = 0; k < region.inside.size(); ++k) {
    ec += elim::elimination_cost(after.dim[k], after.count[k]);
  }
  return ec;
}

std::vector<Index> reordered_subtree(const OrderedElimination& e, const Region& region,
                                     const graph::Order& order) {
  assert(graph::is_permutation(order, region.pattern.variables()));
  std::vector<Index> result;
  for (Index k = e.first[region.root]; k <= region.root; ++k) {
    if (!std::binary_search(region.inside.begin(), region.inside.end(), k)) {
      result.push_back(e.order[k]);
    }
  }
  for (std::size_t k = 0; k < region.inside.size(); ++k) {
    result.push_back(e.order[region.inside[order[k]]]);
  }
  return result;
}

}  // namespace sg::order
