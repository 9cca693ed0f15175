#include "lib/order/region.h"

#include <algorithm>
#include <cassert>
#include <initializer_list>
#include <numeric>
#include <queue>
#include <span>
#include <utility>

#include "lib/elim/bayes_tree.h"
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
void for_children(const Elimination& e, Index k, Function function) {
  for (Index child = k - 1; child >= e.first[k]; child = e.first[child] - 1) function(child);
}

std::vector<Index> top_of_subtree(const Elimination& e, Index root, Index size) {
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
Index first_row(const Elimination& e, Index position) {
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
  const auto rest = row.end() - std::unique(row.begin(), row.end());
  rows.items.resize(rows.items.size() - static_cast<std::size_t>(rest));
  if (!rows.open().empty()) rows.close();
}

// Calls function(child) for every subtree that hangs below R, ascending.
template <class Function>
void each_hanging(const Elimination& e, const Region& region, Function function) {
  std::vector<Index> hanging;
  for (const Index k : region.inside) {
    for_children(e, k, [&](Index child) {
      if (!std::binary_search(region.inside.begin(), region.inside.end(), child))
        hanging.push_back(child);
    });
  }
  std::ranges::sort(hanging);
  for (const Index child : hanging) function(child);
}

void add_own_rows(const Elimination& e, Index k, graph::Lists<>& rows) {
  for (Index r = first_row(e, k); r < e.pattern.rows.size() && e.pattern.rows[r][0] == k; ++r) {
    rows.add(e.pattern.rows[r]);
  }
}

// Renames a region's positions in its rows, fills in dimensions and EC, and returns the positions of B.
std::vector<Index> name_positions(const Elimination& e, Region& region) {
  graph::Lists<>& rows = region.pattern.rows;
  std::vector<Index> positions = region.inside;
  positions.insert(positions.end(), rows.items.begin(), rows.items.end());
  std::sort(positions.begin(), positions.end());
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
  for (Index k : positions) region.pattern.dim.push_back(e.pattern.dim[k]);
  for (Index& k : rows.items) {
    const auto at = std::lower_bound(positions.begin(), positions.end(), k);
    k = static_cast<Index>(at - positions.begin());
  }
  for (Index k : region.inside) region.ec += elim::elimination_cost(e.pattern.dim[k], e.count[k]);
  return {positions.begin() + static_cast<std::ptrdiff_t>(region.inside.size()), positions.end()};
}

// The rows of R, in positions: those that R eliminates, and the separators of what hangs below it.
graph::Lists<> region_rows(const Elimination& e, const std::vector<Index>& inside) {
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
    add_own_rows(e, k, rows);
    for_children(e, k, hanging);
  }
  return rows;
}

}  // namespace

Elimination elimination(const graph::Pattern& pattern, const graph::Order& order) {
  const std::vector<Index> post =
      elim::postorder(elim::elimination_tree(elim::ordered(pattern, order)));
  Elimination e;
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

Region region(const Elimination& e, Index root, Index size) {
  assert(0 <= root && root < static_cast<Index>(e.parent.size()) && size > 0);
  Region result{root, top_of_subtree(e, root, size), {}, 0};
  result.pattern.rows = region_rows(e, result.inside);
  name_positions(e, result);
  return result;
}

std::vector<Region> cut(const Elimination& e, Index size, const std::vector<bool>& left_out) {
  std::vector<Region> regions;
  std::vector<Index> roots;
  for (Index k = 0; k < static_cast<Index>(e.parent.size()); ++k) {
    const Index p = e.parent[k];
    if (!left_out[k] && (p < 0 || left_out[p])) roots.push_back(k);
  }
  std::vector<Index> region_of(e.parent.size(), -1);  // of a root
  for (std::size_t at = 0; at < roots.size(); ++at) {
    region_of[roots[at]] = static_cast<Index>(at);
    regions.push_back({roots[at], top_of_subtree(e, roots[at], size), {}, 0});
    each_hanging(e, regions.back(), [&](Index child) { roots.push_back(child); });
  }
  // From below: what hangs below a region has its separator.
  graph::Lists<> separators;  // of the last region first
  const auto last = static_cast<Index>(regions.size()) - 1;
  for (Index at = last; at >= 0; --at) {
    Region& part = regions[at];
    for (const Index k : part.inside) add_own_rows(e, k, part.pattern.rows);
    each_hanging(e, part, [&](Index child) {
      const auto separator = separators[last - region_of[child]];
      if (!separator.empty()) part.pattern.rows.add(separator);
    });
    separators.add(name_positions(e, part));
  }
  return regions;
}

namespace {

struct Cliques {
  elim::BayesTree tree;
  graph::Lists<> frontals, separators, children;
};

Cliques cliques_of(const Elimination& e) {
  Cliques result{elim::bayes_tree({e.pattern.dim, e.parent, e.count}), {}, {}, {}};
  result.frontals = elim::clique_frontals(result.tree);
  result.separators = elim::clique_separators(e.pattern, result.tree);
  result.children = graph::grouped(result.tree.parent, result.tree.cliques());
  return result;
}

// The frontal variables of one clique, or of one and its child, with what they meet. The first has the top.
Region region_of(const Elimination& e, const Cliques& cliques, std::initializer_list<Index> these) {
  Region region{cliques.tree.top[*these.begin()], {}, {}, 0};
  for (const Index c : these) {
    const auto frontals = cliques.frontals[c];
    region.inside.insert(region.inside.end(), frontals.begin(), frontals.end());
  }
  std::ranges::sort(region.inside);
  graph::Lists<>& rows = region.pattern.rows;
  for (const Index k : region.inside) add_own_rows(e, k, rows);
  for (const Index c : these) {
    for (const Index below : cliques.children[c]) {
      if (std::ranges::find(these, below) != these.end()) continue;
      rows.items.insert(rows.items.end(), cliques.separators[below].begin(),
                        cliques.separators[below].end());
      end_row(rows);
    }
  }
  name_positions(e, region);
  return region;
}

// Those of the parent first, as they are among themselves; then the child's, then what is around.
graph::Order exchanged(const Region& pair, std::span<const Index> parent) {
  graph::Order order(pair.pattern.variables());
  std::iota(order.begin(), order.end(), 0);
  const auto around = order.begin() + static_cast<std::ptrdiff_t>(pair.inside.size());
  std::stable_partition(order.begin(), around, [&](Index k) {
    return std::ranges::binary_search(parent, pair.inside[k]);
  });
  return order;
}

}  // namespace

std::vector<Region> cliques(const Elimination& e, const std::vector<bool>& left_out) {
  const Cliques all = cliques_of(e);
  std::vector<Region> regions;
  for (Index c = 0; c < all.tree.cliques(); ++c) {
    if (!left_out[all.tree.top[c]]) regions.push_back(region_of(e, all, {c}));
  }
  return regions;
}

std::vector<Region> exchanges(const Elimination& e, const std::vector<bool>& left_out,
                              std::vector<graph::Order>& orders) {
  constexpr std::size_t most_children = 64;  // beyond, every pair would look at all of them
  const Cliques cliques = cliques_of(e);
  const elim::BayesTree& tree = cliques.tree;
  std::vector<Region> regions;
  std::vector<bool> paired(tree.cliques(), false);
  for (Index c = 0; c < tree.cliques(); ++c) {
    if (paired[c] || left_out[tree.top[c]]) continue;
    const auto frontals = cliques.frontals[c];
    Region best{tree.top[c], {frontals.begin(), frontals.end()}, {}, 0};
    graph::Order order;
    Index with = -1;
    elim::Wide gain = 0;
    for (const Index child : cliques.children[c]) {
      if (paired[child] || cliques.children[c].size() > most_children) continue;
      Region pair = region_of(e, cliques, {c, child});
      graph::Order other = exchanged(pair, frontals);
      const elim::Wide ec = region_ec(pair, other);
      if (ec + gain >= pair.ec) continue;
      gain = pair.ec - ec;
      with = child;
      best = std::move(pair);
      order = std::move(other);
    }
    if (with >= 0) paired[with] = true;
    regions.push_back(std::move(best));
    orders.push_back(std::move(order));
  }
  return regions;
}

graph::Order recut(const Elimination& e, const std::vector<Region>& regions,
                   const std::vector<graph::Order>& orders) {
  graph::Order result = e.order;
  std::vector<Index> begin = e.first;  // of a root's subtree, in the new order
  for (std::size_t at = 0; at < regions.size(); ++at) {
    const Region& part = regions[at];
    Index place = begin[part.root];
    each_hanging(e, part, [&](Index child) {
      begin[child] = place;
      place += child - e.first[child] + 1;
    });
    for (std::size_t k = 0; k < part.inside.size(); ++k) {
      const std::size_t next = orders[at].empty() ? k : static_cast<std::size_t>(orders[at][k]);
      result[place++] = e.order[part.inside[next]];
    }
  }
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

std::vector<Index> reordered_subtree(const Elimination& e, const Region& region,
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
