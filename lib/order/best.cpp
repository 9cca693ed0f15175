// The best order that a budget buys: an anytime portfolio.
//
// First all other methods of the table, and METIS with ten times the pains, each scored exactly; a few
// of them are polished (polish.h). Then tries, in rounds of a fixed number that run in parallel,
// of two kinds:
//
//   - restarts: a pass of greedy_fill (wmf.h) with random ties and jittered scores, given up as
//     soon as it costs more than the best; on a wide graph, also dissections (dissect.h) by other
//     separators;
//   - local improvement. In the elimination tree of the best order a root r is drawn, and a
//     connected region R at the top of its subtree. No front outside R depends on the order inside
//     R, as long as what hangs below R goes before it and what lies above after: what is eliminated
//     by then is the same. So R is a problem of its own (region.h). Greedy passes reorder it, or on
//     a wide graph dissections, and what it gains there the whole order gains. Of one round,
//     improvements whose subtrees are apart are all taken.
//
// A try depends on its number, the seed, and the best order at the start of its round, not on
// threads or time: a budget in tries gives the same order everywhere. With a budget in seconds,
// methods and tries that would outlast it by what amd took are left out; where amd itself would, a
// coarse dissection (coarse.h) is all there is.
//
// What is minimized is EC, or a price that the caller has for whole orders (OrderOptions): then tries
// still look for lower EC, and what they find is taken where it lowers the price.
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <string_view>
#include <utility>

#include "lib/order/amd.h"
#include "lib/order/coarse.h"
#include "lib/order/constraint.h"
#include "lib/order/dissect.h"
#include "lib/order/methods.h"
#include "lib/order/metis.h"
#include "lib/order/polish.h"
#include "lib/order/region.h"
#include "lib/order/stopwatch.h"
#include "lib/order/supervariables.h"
#include "lib/order/wmf.h"

namespace sg::order::methods {
namespace {

constexpr int tries_a_round = 16;
constexpr int restarts_at_first = 16;
constexpr std::size_t polished_methods = 4;
constexpr double pass_effort = 10;  // of ordering a graph anew, in the time of amd
// Of amd with a score, in the time of listing all neighbours, at most.
constexpr double amd_effort = 8;
constexpr Index large = 50'000;  // variables of a graph that amd orders in no time
constexpr Index coarse_parts = 8;

// Pseudo-random numbers of one try.
struct Draw {
  std::uint64_t state;
  std::uint64_t below(std::uint64_t n) { return mix(++state) % n; }
  double uniform() { return static_cast<double>(mix(++state) >> 11) * 0x1p-53; }
};

// What an order is judged by: the caller's price, or else nothing, and then EC.
struct Price {
  double asked = 0;
  elim::Wide ec = 0;
  friend bool operator<(const Price& a, const Price& b) {
    return a.asked != b.asked ? a.asked < b.asked : a.ec < b.ec;
  }
};

// What all tries of a round share.
struct Search {
  const graph::Pattern& pattern;
  const OrderOptions& options;
  graph::Adjacency graph;
  std::vector<int> stage = {};    // 1 of the variables of `last`
  graph::Order order = {};        // the best so far
  Price price = {};               // of it
  Elimination best = {};          // the same in a postorder, once tries begin
  std::vector<double> cost = {};  // running sum of the costs of best's variables
  Stopwatch clock = {};
  double amd_seconds = 0;  // with a score
  bool wide = false;       // dissections are worth a try
};

bool stopped(const Search& search) {
  return search.options.stop && search.options.stop();
}

// Whether the budget has so many seconds left, or time for so many times what amd took.
bool lasts(const Search& search, double seconds) {
  const double budget = search.options.budget.seconds;
  return budget <= 0 || search.clock.seconds() + seconds < budget;
}
bool time_for(const Search& search, double effort) {
  return !stopped(search) && lasts(search, effort * search.amd_seconds);
}

struct Try {
  graph::Order order;          // of a restart that is better; empty otherwise
  Index begin = 0;             // positions that a local improvement reorders
  std::vector<Index> subtree;  // empty without one
  elim::Wide gain = 0;
};

Price price_of(const Search& search, const graph::Order& order, elim::Wide ec) {
  const auto& asked = search.options.price;
  return {asked ? asked(search.pattern, order) : 0, ec};
}

void take(Search& search, const graph::Order& order, const Price& price) {
  search.order = order;
  search.price = price;
}

// What tries start from.
void set_out(Search& search, Elimination&& elimination) {
  search.best = std::move(elimination);
  search.cost.clear();
  double sum = 0;
  for (std::size_t k = 0; k < search.best.count.size(); ++k) {
    sum +=
        elim::to_double(elim::elimination_cost(search.best.pattern.dim[k], search.best.count[k]));
    search.cost.push_back(sum);
  }
}

GreedyOptions drawn_options(Draw& draw) {
  constexpr double jitters[] = {0, 0.1, 0.3, 1};
  GreedyOptions options;
  options.seed = draw.below(~std::uint64_t{0}) + 1;
  options.jitter = jitters[draw.below(std::size(jitters))];
  if (draw.below(4) == 0) options.score = FillScore::plain;
  if (draw.below(8) == 0) options.exact_work = 0;
  return options;
}

Try better_order(const Search& search, graph::Order order, elim::Wide ec) {
  Try found;
  if (ec >= search.best.ec) return found;
  found.order = std::move(order);
  found.gain = search.best.ec - ec;
  return found;
}

Try other_dissection(const Search& search, Draw draw) {
  graph::Order order = dissect(search.graph, search.pattern.dim, draw.below(1 << 30));
  const elim::Wide ec = elim::elimination_complexity(search.pattern, order);
  return better_order(search, std::move(order), ec);
}

Try restart(const Search& search, Draw draw) {
  if (!time_for(search, pass_effort)) return {};
  if (search.wide && draw.below(2) == 0) return other_dissection(search, draw);
  GreedyOptions options = drawn_options(draw);
  options.stage = search.stage;
  options.limit = search.best.ec;
  GreedyResult result = greedy_fill(search.pattern, search.graph, options);
  return better_order(search, std::move(result.order), result.ec);
}

// A position drawn in proportion to its cost, and from there up to a subtree of this size.
Index drawn_root(const Search& search, Index size, Draw& draw) {
  const double at = draw.uniform() * search.cost.back();
  const auto drawn = std::upper_bound(search.cost.begin(), search.cost.end() - 1, at);
  auto root = static_cast<Index>(drawn - search.cost.begin());
  while (root - search.best.first[root] + 1 < size && search.best.parent[root] >= 0) {
    root = search.best.parent[root];
  }
  return root;
}

// `last` after the others, and what lies above the region after that.
std::vector<int> region_stages(const Search& search, const Region& region) {
  std::vector<int> stage(region.pattern.variables(), 2);
  for (std::size_t k = 0; k < region.inside.size(); ++k) {
    stage[k] = search.stage[search.best.order[region.inside[k]]];
  }
  return stage;
}

// An order of a region and what is around it.
graph::Order drawn_order(const Search& search, const Region& part, Draw& draw) {
  const graph::Adjacency graph = graph::adjacency(part.pattern);
  if (search.wide && draw.below(2) == 0) {
    const auto inner = static_cast<Index>(part.inside.size());
    graph::Order order =
        nested_dissection(graph, part.pattern.dim, inner, draw.below(1 << 30)).order;
    for (Index v = inner; v < part.pattern.variables(); ++v) order.push_back(v);
    return order;
  }
  GreedyOptions options = drawn_options(draw);
  options.stage = region_stages(search, part);
  return greedy_fill(part.pattern, graph, options).order;
}

Try local(const Search& search, Draw draw) {
  const double largest = std::log2(std::max<double>(8, search.pattern.variables()));
  const auto size = static_cast<Index>(std::exp2(3 + draw.uniform() * (largest - 3)));
  if (!time_for(search, pass_effort * size / search.pattern.variables())) return {};
  const Region part = region(search.best, drawn_root(search, size, draw), size);
  const graph::Order order = drawn_order(search, part, draw);
  const elim::Wide ec = region_ec(part, order);
  Try found;
  if (ec < part.ec) {
    found.begin = search.best.first[part.root];
    found.subtree = reordered_subtree(search.best, part, order);
    found.gain = part.ec - ec;
  }
  return found;
}

Try one_try(const Search& search, int number) {
  Draw draw{mix(search.options.seed) + mix(static_cast<std::uint64_t>(number))};
  const bool from_scratch = number < restarts_at_first || draw.below(8) == 0;
  return (from_scratch ? restart : local)(search, draw);
}

// The best order with all local improvements that are apart, the largest first.
graph::Order with_improvements(const Search& search, std::vector<Try>& tries) {
  std::stable_sort(tries.begin(), tries.end(),
                   [](const Try& a, const Try& b) { return a.gain > b.gain; });
  graph::Order order = search.best.order;
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

void report(const Search& search, std::string_view how, int tries) {
  if (!search.options.report) return;
  search.options.report({how, tries, search.clock.seconds(), search.price.ec, search.price.asked});
}

constexpr Ordering tuned{"metis+", "METIS, 20 separators and 100 refinements at every level",
                         tuned_metis};

// CPU time of a method in that of amd, about, on a large graph. That of wmf depends on its width.
double effort(const Ordering& method, bool wide) {
  if (method.compute == tuned_metis) return 120;
  if (method.compute == sloan) return 25;
  if (method.compute == wmf && wide) return 60;
  const std::array around_ten{wmf, metis, scotch, mmd};
  if (std::ranges::find(around_ten, method.compute) != around_ten.end()) return 10;
  return 2;
}

struct Found {
  graph::Order order;  // empty: there was no time for it
  Price price;
};

Found scored(const Search& search, graph::Order&& order) {
  const elim::Wide ec = elim::elimination_complexity(search.pattern, order);
  const Price price = price_of(search, order, ec);
  return {std::move(order), price};
}

Found found_by(const Search& search, const Ordering& method) {
  return scored(search, elimination_order(method, search.pattern, search.options));
}

// Whether there is time for amd, by a guess.
bool amd_lasts(Search& search) {
  search.amd_seconds = amd_effort * search.clock.seconds();
  return search.graph.size() <= large || lasts(search, search.amd_seconds);
}

// In place of all methods where not even amd would last.
std::vector<Found> take_coarse(Search& search) {
  graph::Order order = coarse_dissection(search.graph, search.graph.size() / coarse_parts);
  move_to_end(order, search.options.last);
  std::vector<Found> found;
  found.push_back(scored(search, std::move(order)));
  take(search, found.front().order, found.front().price);
  report(search, "coarse", 0);
  return found;
}

// Calls work(k) for 0 .. count - 1 on all threads, and begins them in this order.
template <class Work>
void in_turn(std::size_t count, const Work& work) {
  std::atomic<std::size_t> next = 0;
  tbb::parallel_for(0, tbb::this_task_arena::max_concurrency(), [&](int) {
    for (std::size_t k = next++; k < count; k = next++) work(k);
  });
}

// Takes the best of all other methods that there is time for, the quick ones first; of equals the one that stands first in
// the table. amd is the measure of the others, and there in any case. Returns the few that are worth polishing.
std::vector<Found> take_best_method(Search& search) {
  std::vector<const Ordering*> methods;
  for (const Ordering& method : orderings()) {
    if (method.compute != best) methods.push_back(&method);
  }
  methods.push_back(&tuned);
  std::vector<Found> found(methods.size());
  const auto is_amd = [](const Ordering* method) { return method->compute == amd; };
  const auto measure =
      static_cast<std::size_t>(std::ranges::find_if(methods, is_amd) - methods.begin());
  const double start = search.clock.seconds();
  found[measure] = scored(search, minimum_degree(search.graph, search.options.last));
  search.amd_seconds = search.clock.seconds() - start;
  const bool wide = is_wide(search.graph, found[measure].price.ec);

  std::vector<std::size_t> turn(methods.size());
  std::iota(turn.begin(), turn.end(), 0);
  std::ranges::stable_sort(turn, {}, [&](std::size_t k) { return effort(*methods[k], wide); });
  in_turn(turn.size(), [&](std::size_t k) {
    const Ordering& method = *methods[turn[k]];
    if (turn[k] != measure && time_for(search, effort(method, wide)))
      found[turn[k]] = found_by(search, method);
  });
  for (Found& method : found) {
    if (method.order.empty()) method.price = {std::numeric_limits<double>::infinity(), 0};
  }
  std::iota(turn.begin(), turn.end(), 0);
  std::ranges::stable_sort(
      turn, [&](std::size_t a, std::size_t b) { return found[a].price < found[b].price; });
  const Found& least = found[turn.front()];
  take(search, least.order, least.price);
  report(search, methods[turn.front()]->name, 0);
  std::vector<Found> first;
  for (const std::size_t k : turn) {
    const bool worth = !found[k].order.empty() && found[k].price.ec < 2 * search.price.ec;
    if (worth && first.size() < polished_methods) first.push_back(std::move(found[k]));
  }
  return first;
}

// What is best before polishing need not be after it.
void take_best_polished(Search& search, const std::vector<Found>& methods) {
  PolishOptions options;
  options.last = search.options.last;
  options.stop = [&](double seconds) { return stopped(search) || !lasts(search, seconds); };
  for (const Found& method : methods) {
    if (!time_for(search, 1)) return;
    Polished polished = polish(search.pattern, method.order, options);
    const Price price = price_of(search, polished.order, polished.ec);
    if (!(price < search.price)) continue;
    take(search, polished.order, price);
    report(search, "polish", 0);
  }
}

// Whether the round improved the best.
void take_round(Search& search, std::vector<Try>& tries, int done) {
  if (std::ranges::none_of(tries, [](const Try& found) { return found.gain > 0; })) return;
  const auto restarted =
      std::max_element(tries.begin(), tries.end(), [](const Try& a, const Try& b) {
        return (a.order.empty() ? 0 : a.gain) < (b.order.empty() ? 0 : b.gain);
      });
  const graph::Order fresh = restarted->order;
  Elimination improved = elimination(search.pattern, with_improvements(search, tries));
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
  set_out(search, std::move(improved));
  report(search, how, done);
}

}  // namespace

graph::Order best(const graph::Pattern& pattern, const OrderOptions& options) {
  const Stopwatch clock;
  Search search{pattern, options, graph::adjacency(pattern)};
  search.clock = clock;
  search.stage.assign(pattern.variables(), 0);
  for (Index j : options.last) search.stage.at(j) = 1;
  const std::vector<Found> methods =
      amd_lasts(search) ? take_best_method(search) : take_coarse(search);
  if (pattern.variables() == 0) return {};
  take_best_polished(search, methods);
  const Budget& budget = options.budget;
  if (!time_for(search, 1)) return std::move(search.order);
  set_out(search, elimination(pattern, search.order));
  search.wide = options.last.empty() && is_wide(search.graph, search.price.ec);
  const auto time_left = [&] { return time_for(search, 0); };
  const auto tries_left = [&](int done) { return budget.seconds > 0 || done < budget.tries; };
  for (int done = 0; tries_left(done) && time_left(); done += tries_a_round) {
    std::vector<Try> tries(tries_a_round);
    tbb::parallel_for(0, tries_a_round, [&](int i) {
      if (tries_left(done + i) && time_left()) tries[i] = one_try(search, done + i);
    });
    take_round(search, tries, done + tries_a_round);
  }
  return std::move(search.order);
}

}  // namespace sg::order::methods
