#include "lib/order/best_tries.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "lib/order/dissect.h"
#include "lib/order/region.h"
#include "lib/order/supervariables.h"
#include "lib/order/wmf.h"
#include "lib/parallel/parallel.h"

namespace sg::order {
namespace {

constexpr int tries_a_round = 16;
constexpr int restarts_at_first = 16;
constexpr double pass_effort = 10;  // of ordering a graph anew, in the time of amd

// Pseudo-random numbers of one try.
struct Draw {
  std::uint64_t state;
  std::uint64_t below(std::uint64_t n) { return mix(++state) % n; }
  double uniform() { return static_cast<double>(mix(++state) >> 11) * 0x1p-53; }
};

// What tries start from.
struct Start {
  const Search& search;
  Elimination best;          // the best order, postordered
  std::vector<double> cost;  // running sum of the costs of its variables
  bool wide;                 // dissections are worth a try
};

void set_out(Start& start, Elimination&& elimination) {
  start.best = std::move(elimination);
  start.cost.clear();
  double sum = 0;
  for (std::size_t k = 0; k < start.best.count.size(); ++k) {
    sum += elim::to_double(elim::elimination_cost(start.best.pattern.dim[k], start.best.count[k]));
    start.cost.push_back(sum);
  }
}

struct Try {
  graph::Order order;          // of a restart that is better; empty otherwise
  Index begin = 0;             // positions that a local improvement reorders
  std::vector<Index> subtree;  // empty without one
  elim::Wide gain = 0;
};

GreedyOptions drawn_options(Draw& draw) {
  constexpr double jitters[] = {0, 0.1, 0.3, 1};
  GreedyOptions options;
  options.seed = draw.below(~std::uint64_t{0}) + 1;
  options.jitter = jitters[draw.below(std::size(jitters))];
  if (draw.below(4) == 0) options.score = FillScore::plain;
  if (draw.below(8) == 0) options.exact_work = 0;
  return options;
}

Try better_order(const Start& start, graph::Order order, elim::Wide ec) {
  Try found;
  if (ec >= start.best.ec) return found;
  found.order = std::move(order);
  found.gain = start.best.ec - ec;
  return found;
}

Try other_dissection(const Start& start, Draw draw) {
  graph::Order order = dissect(start.search.graph, start.search.pattern.dim, draw.below(1 << 30));
  const elim::Wide ec = elim::elimination_complexity(start.search.pattern, order);
  return better_order(start, std::move(order), ec);
}

Try restart(const Start& start, Draw draw) {
  if (!time_for(start.search, pass_effort)) return {};
  if (start.wide && draw.below(2) == 0) return other_dissection(start, draw);
  GreedyOptions options = drawn_options(draw);
  options.stage = start.search.stage;
  options.limit = start.best.ec;
  GreedyResult result = greedy_fill(start.search.pattern, start.search.graph, options);
  return better_order(start, std::move(result.order), result.ec);
}

// A position drawn in proportion to its cost, and from there up to a subtree of this size.
Index drawn_root(const Start& start, Index size, Draw& draw) {
  const double at = draw.uniform() * start.cost.back();
  const auto drawn = std::upper_bound(start.cost.begin(), start.cost.end() - 1, at);
  auto root = static_cast<Index>(drawn - start.cost.begin());
  while (root - start.best.first[root] + 1 < size && start.best.parent[root] >= 0) {
    root = start.best.parent[root];
  }
  return root;
}

// `last` after the others, and what lies above the region after that.
std::vector<int> region_stages(const Start& start, const Region& region) {
  std::vector<int> stage(region.pattern.variables(), 2);
  for (std::size_t k = 0; k < region.inside.size(); ++k) {
    stage[k] = start.search.stage[start.best.order[region.inside[k]]];
  }
  return stage;
}

// An order of a region and what is around it.
graph::Order drawn_order(const Start& start, const Region& part, Draw& draw) {
  const graph::Adjacency graph = graph::adjacency(part.pattern);
  if (start.wide && draw.below(2) == 0) {
    const auto inner = static_cast<Index>(part.inside.size());
    graph::Order order =
        nested_dissection(graph, part.pattern.dim, inner, draw.below(1 << 30)).order;
    for (Index v = inner; v < part.pattern.variables(); ++v) order.push_back(v);
    return order;
  }
  GreedyOptions options = drawn_options(draw);
  options.stage = region_stages(start, part);
  return greedy_fill(part.pattern, graph, options).order;
}

Try local(const Start& start, Draw draw) {
  const double largest = std::log2(std::max<double>(8, start.search.pattern.variables()));
  const auto size = static_cast<Index>(std::exp2(3 + draw.uniform() * (largest - 3)));
  if (!time_for(start.search, pass_effort * size / start.search.pattern.variables())) return {};
  const Region part = region(start.best, drawn_root(start, size, draw), size);
  const graph::Order order = drawn_order(start, part, draw);
  const elim::Wide ec = region_ec(part, order);
  Try found;
  if (ec < part.ec) {
    found.begin = start.best.first[part.root];
    found.subtree = reordered_subtree(start.best, part, order);
    found.gain = part.ec - ec;
  }
  return found;
}

Try one_try(const Start& start, int number) {
  Draw draw{mix(start.search.options.seed) + mix(static_cast<std::uint64_t>(number))};
  const bool from_scratch = number < restarts_at_first || draw.below(8) == 0;
  return (from_scratch ? restart : local)(start, draw);
}

// The best order with all local improvements that are apart, the largest first.
graph::Order with_improvements(const Start& start, std::vector<Try>& tries) {
  std::stable_sort(tries.begin(), tries.end(),
                   [](const Try& a, const Try& b) { return a.gain > b.gain; });
  graph::Order order = start.best.order;
  std::vector<char> touched(order.size(), false);
  for (const Try& found : tries) {
    const auto begin = touched.begin() + found.begin;
    const auto end = begin + static_cast<std::ptrdiff_t>(found.subtree.size());
    if (std::find(begin, end, true) != end) continue;
    std::fill(begin, end, true);
    std::copy(found.subtree.begin(), found.subtree.end(), order.begin() + found.begin);
  }
  return order;
}

// What a round found, if that is better.
void take_round(Search& search, Start& start, std::vector<Try>& tries, int done) {
  if (std::ranges::none_of(tries, [](const Try& found) { return found.gain > 0; })) return;
  const auto restarted =
      std::max_element(tries.begin(), tries.end(), [](const Try& a, const Try& b) {
        return (a.order.empty() ? 0 : a.gain) < (b.order.empty() ? 0 : b.gain);
      });
  const graph::Order fresh = restarted->order;
  Elimination improved = elimination(search.pattern, with_improvements(start, tries));
  Price price = price_of(search, improved.order, improved.ec);
  std::string_view how = "local";
  if (!fresh.empty()) {
    Elimination other = elimination(search.pattern, fresh);
    if (const Price its = price_of(search, other.order, other.ec); its < price) {
      improved = std::move(other);
      price = its;
      how = "restart";
    }
  }
  if (!(price < search.price)) return;
  take(search, improved.order, price);
  set_out(start, std::move(improved));
  report(search, how, done);
}

}  // namespace

void take_best_of_tries(Search& search) {
  if (!time_for(search, 1)) return;
  const bool wide = search.options.last.empty() && is_wide(search.graph, search.price.ec);
  Start start{search, {}, {}, wide};
  set_out(start, elimination(search.pattern, search.order));
  const Budget& budget = search.options.budget;
  const auto time_left = [&] { return time_for(search, 0); };
  const auto tries_left = [&](int done) { return budget.seconds > 0 || done < budget.tries; };
  for (int done = 0; tries_left(done) && time_left(); done += tries_a_round) {
    std::vector<Try> tries(tries_a_round);
    parallel::each(tries_a_round, [&](int i) {
      if (tries_left(done + i) && time_left()) tries[i] = one_try(start, done + i);
    });
    take_round(search, start, tries, done + tries_a_round);
  }
}

}  // namespace sg::order
