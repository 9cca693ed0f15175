#include "lib/order/best_search.h"

namespace sg::order {

bool stopped(const Search& search) {
  return search.options.stop && search.options.stop();
}

bool lasts(const Search& search, double seconds) {
  const double budget = search.options.budget.seconds;
  return budget <= 0 || search.clock.seconds() + seconds < budget;
}
bool time_for(const Search& search, double effort) {
  return !stopped(search) && lasts(search, effort * search.amd_seconds);
}

Price price_of(const Search& search, const graph::Order& order, elim::Wide ec) {
  const auto& asked = search.options.price;
  return {asked ? asked(search.pattern, order) : 0, ec};
}

void take(Search& search, const graph::Order& order, const Price& price) {
  search.order = order;
  search.price = price;
}

void report(const Search& search, std::string_view how, int tries) {
  if (!search.options.report) return;
  search.options.report({how, tries, search.clock.seconds(), search.price.ec, search.price.asked});
}

}  // namespace sg::order
