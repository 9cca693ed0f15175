// Quick in total, to order and to eliminate: COLAMD's order, or weighted minimum fill's where eliminating by COLAMD's would
// take so long that a better order pays for a longer search. Made for what is ordered again and again, as iSAM2's tops are.
#include "lib/elim/score.h"
#include "lib/order/methods.h"

namespace sg::order::methods {
namespace {

// EC for every variable and every entry of a row, from where on wmf pays. Its search takes some microseconds for each; three
// thousand of EC take a tenth of one, and there are graphs, and steps, of a thousand times as many.
constexpr double wmf_pays = 3e3;

}  // namespace

graph::Order quick(const graph::Pattern& pattern, const OrderOptions& options) {
  graph::Order order = colamd(pattern, options);
  const elim::Wide ec = elim::elimination_complexity(pattern, order);
  const auto size = static_cast<double>(pattern.dim.size() + pattern.rows.items.size());
  if (elim::to_double(ec) < wmf_pays * size) return order;
  graph::Order other = wmf(pattern, options);
  return elim::elimination_complexity(pattern, other) < ec ? other : order;
}

}  // namespace sg::order::methods
