#include "lib/elim/clique_lists.h"

#include <algorithm>

#include "lib/elim/etree.h"

namespace sg::elim {
namespace {

// A clique while variables may join it still.
struct Open {
  Index top;         // its last position so far
  Index begin, end;  // its separator, in items
  Index next;        // that waits for the same variable, -1
};

struct Pass {
  const graph::Pattern& pattern;
  std::vector<Index> position;  // of every variable
  graph::Lists<> rows;          // by their first position
  std::vector<Open> open;
  std::vector<Index> waiting;  // by position: the last clique that waits for it, -1
  std::vector<Index> named;    // by position: by which variable's separator, last
  std::vector<Index> above;    // by clique: the position of its parent, -1
  CliqueLists& result;
};

graph::Lists<> rows_by_first(const graph::Pattern& pattern, const std::vector<Index>& position,
                             std::vector<Index>& first) {
  first.resize(pattern.rows.size());
  for (Index r = 0; r < pattern.rows.size(); ++r) {
    Index least = -1;
    for (Index j : pattern.rows[r]) least = least < 0 ? position[j] : std::min(least, position[j]);
    first[r] = least;
  }
  return graph::grouped(first, pattern.variables());
}

Index longest_waiting(const Pass& pass, Index k) {
  Index longest = -1, size = 0;
  for (Index c = pass.waiting[k]; c >= 0; c = pass.open[c].next) {
    const Index own = pass.open[c].end - pass.open[c].begin;
    if (own <= size) continue;
    longest = c;
    size = own;
  }
  return longest;
}

// Appends to items what is in k's separator and not in that of clique `known` (-1: none).
void append_new(Pass& pass, Index k, Index known) {
  std::vector<Index>& items = pass.result.items;
  std::vector<Index>& named = pass.named;
  named[k] = k;
  if (known >= 0) {
    for (Index i = pass.open[known].begin; i < pass.open[known].end; ++i) named[items[i]] = k;
  }
  const auto name = [&](Index p) {
    if (named[p] == k) return;
    named[p] = k;
    items.push_back(p);
  };
  for (Index r : pass.rows[k]) {
    for (Index j : pass.pattern.rows[r]) name(pass.position[j]);
  }
  for (Index c = pass.waiting[k]; c >= 0; c = pass.open[c].next) {
    if (c == known) continue;
    for (Index i = pass.open[c].begin; i < pass.open[c].end; ++i) name(items[i]);  // items move
  }
}

// Items from `first` on, and those of [begin, end) of them, become one ascending list at the end.
void merge_in(std::vector<Index>& items, Index first, Index begin, Index end) {
  std::sort(items.begin() + first, items.end());
  auto own = static_cast<Index>(items.size());
  items.resize(items.size() + (end - begin));
  for (auto to = static_cast<Index>(items.size()); end > begin;) {
    const bool larger = own > first && items[own - 1] > items[end - 1];
    items[--to] = larger ? items[--own] : items[--end];
  }
}

void visit(Pass& pass, Index k) {
  std::vector<Index>& items = pass.result.items;
  const Index known = longest_waiting(pass, k);
  const auto first = static_cast<Index>(items.size());
  append_new(pass, k, known);
  const bool joins = known >= 0 && first == static_cast<Index>(items.size());
  const Index c = joins ? known : static_cast<Index>(pass.open.size());
  for (Index below = pass.waiting[k]; below >= 0;) {
    if (below != c) pass.above[below] = k;
    below = pass.open[below].next;
  }
  if (joins) {
    pass.open[c].top = k;
    ++pass.open[c].begin;
  } else {
    if (known >= 0) merge_in(items, first, pass.open[known].begin + 1, pass.open[known].end);
    if (known < 0) std::sort(items.begin() + first, items.end());
    pass.open.push_back({k, first, graph::item_count(items.size()), -1});
    pass.above.push_back(-1);
  }
  pass.result.clique[k] = c;
  Open& clique = pass.open[c];
  if (clique.begin == clique.end) return;
  clique.next = pass.waiting[items[clique.begin]];
  pass.waiting[items[clique.begin]] = c;
}

// Cliques by their last positions, with what is to be told of them.
void number(const Pass& pass, const graph::Order& order) {
  CliqueLists& result = pass.result;
  const auto n = static_cast<Index>(order.size());
  std::vector<Index> number(pass.open.size());
  Index count = 0;
  for (Index k = 0; k < n; ++k) {
    if (pass.open[result.clique[k]].top == k) number[result.clique[k]] = count++;
  }
  const std::vector<int>& dim = pass.pattern.dim;
  result.frontal_dim.assign(count, 0);
  for (Index k = 0; k < n; ++k) {
    result.clique[k] = number[result.clique[k]];
    result.frontal_dim[result.clique[k]] += dim[order[k]];
  }
  for (auto* const list : {&result.parent, &result.separator_begin, &result.separator_end})
    list->resize(count);
  result.separator_dim.assign(count, 0);
  for (std::size_t c = 0; c < pass.open.size(); ++c) {
    const Open& clique = pass.open[c];
    const Index to = number[c];
    result.parent[to] = pass.above[c] < 0 ? -1 : result.clique[pass.above[c]];
    result.separator_begin[to] = clique.begin;
    result.separator_end[to] = clique.end;
    for (Index i = clique.begin; i < clique.end; ++i)
      result.separator_dim[to] += dim[order[result.items[i]]];
  }
}

}  // namespace

CliqueLists clique_lists(const graph::Pattern& pattern, const graph::Order& order) {
  const Index n = pattern.variables();
  CliqueLists result;
  Pass pass{pattern, positions(order, n), {}, {}, {}, {}, {}, result};
  pass.rows = rows_by_first(pattern, pass.position, result.row_first);
  pass.waiting.assign(n, -1);
  pass.named.assign(n, -1);
  result.clique.resize(n);
  result.items.reserve(4 * static_cast<std::size_t>(n));
  for (Index k = 0; k < n; ++k) visit(pass, k);
  number(pass, order);
  return result;
}

}  // namespace sg::elim
