// The best order that a budget buys: an anytime portfolio of all other methods (best_methods.h), and tries to better what
// they found (best_tries.h).
//
// What is minimized is EC, or a price that the caller has for whole orders (OrderOptions): then tries
// still look for lower EC, and what they find is taken where it lowers the price.
#include <utility>

#include "lib/order/best_methods.h"
#include "lib/order/best_tries.h"
#include "lib/order/methods.h"

namespace sg::order::methods {

graph::Order best(const graph::Pattern& pattern, const OrderOptions& options) {
  const Stopwatch clock;
  Search search{pattern, options, graph::adjacency(pattern)};
  search.clock = clock;
  search.stage.assign(pattern.variables(), 0);
  for (const Index j : options.last) search.stage.at(j) = 1;
  take_best_method(search);
  if (pattern.variables() == 0) return {};
  take_best_of_tries(search);
  return std::move(search.order);
}

}  // namespace sg::order::methods
