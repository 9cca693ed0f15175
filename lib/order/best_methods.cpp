#include "lib/order/best_methods.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <numeric>
#include <utility>

#include "lib/order/amd.h"
#include "lib/order/coarse.h"
#include "lib/order/constraint.h"
#include "lib/order/methods.h"
#include "lib/order/metis.h"
#include "lib/order/polish.h"
#include "lib/order/wmf.h"
#include "lib/parallel/parallel.h"

namespace sg::order {
namespace {

constexpr std::size_t polished_methods = 4;
// Of amd with a score, in the time of listing all neighbours, at most.
constexpr double amd_effort = 8;
constexpr Index large = 50'000;  // variables of a graph that amd orders in no time
constexpr Index coarse_parts = 8;

constexpr Ordering tuned{"metis+", "METIS, 20 separators and 100 refinements at every level",
                         tuned_metis};

// CPU time of a method in that of amd, about, on a large graph. That of wmf depends on its width.
double effort(const Ordering& method, bool wide) {
  if (method.compute == tuned_metis) return 120;
  if (method.compute == methods::sloan) return 25;
  if (method.compute == methods::wmf && wide) return 60;
  const std::array around_ten{methods::wmf, methods::metis, methods::scotch, methods::mmd};
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
  parallel::each(tbb::this_task_arena::max_concurrency(), [&](int) {
    for (std::size_t k = next++; k < count; k = next++) work(k);
  });
}

// Takes the best of all other methods that there is time for, the quick ones first; of equals the one that stands first in
// the table. amd is the measure of the others, and there in any case. Returns the few that are worth polishing.
std::vector<Found> methods_found(Search& search) {
  std::vector<const Ordering*> table;
  for (const Ordering& method : orderings()) {
    // quick is one of two others.
    if (method.compute != methods::best && method.compute != methods::quick)
      table.push_back(&method);
  }
  table.push_back(&tuned);
  std::vector<Found> found(table.size());
  const auto is_amd = [](const Ordering* method) { return method->compute == methods::amd; };
  const auto measure =
      static_cast<std::size_t>(std::ranges::find_if(table, is_amd) - table.begin());
  const double start = search.clock.seconds();
  found[measure] = scored(search, minimum_degree(search.graph, search.options.last));
  search.amd_seconds = search.clock.seconds() - start;
  const bool wide = is_wide(search.graph, found[measure].price.ec);

  std::vector<std::size_t> turn(table.size());
  std::iota(turn.begin(), turn.end(), 0);
  std::ranges::stable_sort(turn, {}, [&](std::size_t k) { return effort(*table[k], wide); });
  in_turn(turn.size(), [&](std::size_t k) {
    const Ordering& method = *table[turn[k]];
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
  report(search, table[turn.front()]->name, 0);
  std::vector<Found> first;
  for (const std::size_t k : turn) {
    const bool worth = !found[k].order.empty() && found[k].price.ec < 2 * search.price.ec;
    if (worth && first.size() < polished_methods) first.push_back(std::move(found[k]));
  }
  return first;
}

// What is best before polishing need not be after it.
void take_best_polished(Search& search, const std::vector<Found>& found) {
  PolishOptions options;
  options.last = search.options.last;
  options.stop = [&](double seconds) { return stopped(search) || !lasts(search, seconds); };
  for (const Found& method : found) {
    if (!time_for(search, 1)) return;
    Polished polished = polish(search.pattern, method.order, options);
    const Price price = price_of(search, polished.order, polished.ec);
    if (!(price < search.price)) continue;
    take(search, polished.order, price);
    report(search, "polish", 0);
  }
}

}  // namespace

void take_best_method(Search& search) {
  const std::vector<Found> found = amd_lasts(search) ? methods_found(search) : take_coarse(search);
  take_best_polished(search, found);
}

}  // namespace sg::order
