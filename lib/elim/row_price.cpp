#include "lib/elim/row_price.h"

#include <algorithm>

#include "lib/elim/structure.h"

namespace sg::elim {
namespace {

// R's block structure, and how many rows and children bring each variable to a separator.
struct Structure {
  std::vector<int> dim;
  std::vector<Index> parent;
  std::vector<std::int64_t> count;  // d_f + d_s
  graph::Lists<> separators;        // ascending
  std::vector<Index> brought;       // by item of separators

  Index& brings(Index k, Index x) {
    const auto separator = separators[k];
    return brought[separators.begin[k] +
                   (std::ranges::lower_bound(separator, x) - separator.begin())];
  }
};

Structure structure_of(const OrderedPattern& pattern) {
  Structure r;
  r.dim = pattern.dim;
  r.parent = elimination_tree(pattern);
  visit_separators(pattern, r.parent, [&](Index k, std::span<const Index> separator) {
    r.separators.add(separator);
    r.count.push_back(r.dim[k]);
    for (const Index x : separator) r.count.back() += r.dim[x];
  });
  r.brought.assign(r.separators.items.size(), 0);
  for (Index i = 0; i < pattern.rows.size(); ++i) {
    const auto row = pattern.rows[i];
    for (const Index x : row.subspan(1)) ++r.brings(row.front(), x);
  }
  for (Index k = 0; k < pattern.variables(); ++k) {
    for (const Index x : r.separators[k]) {
      if (x != r.parent[k]) ++r.brings(r.parent[k], x);
    }
  }
  return r;
}

// A variable on the way up, and what the row's removal does to it.
struct Step {
  Index k;
  std::vector<Index> left;  // its separator, ascending
  Index parent;             // what it hangs on then
};

bool has_left(const Step& step, Index x) {
  return std::ranges::binary_search(step.left, x);
}

// What elimination of step.k costs less.
Wide saved(const Structure& r, const Step& step) {
  std::int64_t less = 0;
  for (const Index x : step.left) less += r.dim[x];
  const std::int64_t d = r.dim[step.k], total = r.count[step.k];
  return elimination_cost(d, total) - elimination_cost(d, total - less);
}

Index first_that_stays(const Structure& r, const Step& step) {
  const auto separator = r.separators[step.k];
  const auto first = std::ranges::find_if(separator, [&](Index x) { return !has_left(step, x); });
  return first == separator.end() ? -1 : *first;
}

struct Walk {
  Structure r;
  std::vector<Index>
      gained;  // n: what steps that hang on a variable now bring it, by variable; else 0
  std::vector<Step> hanging;  // on other variables than before, further up

  void count_gained(Index above, int by) {
    for (const Step& step : hanging) {
      if (step.parent != above) continue;
      for (const Index x : r.separators[step.k]) gained[x] += has_left(step, x) ? 0 : by;
    }
  }

  // From a variable to its parent.
  Step up(Step&& from) {
    const Index above = r.parent[from.k];
    count_gained(above, 1);
    Step to{above, {}, -1};
    const auto lose = [&](Index x) {
      if (x != above && r.brings(above, x) + gained[x] == 1) to.left.push_back(x);
    };
    std::ranges::for_each(
        from.parent == above ? std::span<const Index>(from.left) : r.separators[from.k], lose);
    count_gained(above, -1);
    std::erase_if(hanging, [&](const Step& step) { return step.parent == above; });
    if (from.parent >= 0 && from.parent != above) hanging.push_back(std::move(from));
    return to;
  }

  // row: ascending positions
  Wide price(std::span<const Index> row) {
    if (row.size() < 2) return 0;
    Step step{row.front(), {}, -1};
    for (const Index x : row.subspan(1)) {
      if (r.brings(step.k, x) == 1) step.left.push_back(x);
    }
    Wide sum = 0;
    hanging.clear();
    while (!step.left.empty() || !hanging.empty()) {
      sum += saved(r, step);
      step.parent = first_that_stays(r, step);
      if (r.parent[step.k] < 0) break;
      step = up(std::move(step));
    }
    return sum;
  }
};

}  // namespace

std::vector<Wide> row_prices(const graph::Pattern& pattern, const graph::Order& order) {
  Walk walk{structure_of(ordered(pattern, order)), std::vector<Index>(pattern.variables(), 0), {}};
  std::vector<Index> position(pattern.variables());
  for (Index k = 0; k < pattern.variables(); ++k) position[order[k]] = k;
  std::vector<Wide> prices;
  std::vector<Index> row;
  for (Index i = 0; i < pattern.rows.size(); ++i) {
    row.clear();
    for (const Index j : pattern.rows[i]) row.push_back(position[j]);
    std::ranges::sort(row);
    prices.push_back(walk.price(row));
  }
  return prices;
}

}  // namespace sg::elim
