// Quick in total, to order and to eliminate: COLAMD's order, or weighted minimum fill's where eliminating by COLAMD's would
// take so long that a better order pays for a longer search. Made for what is ordered again and again, as iSAM2's tops are.
#include <algorithm>

#include "lib/elim/score.h"
#include "lib/order/methods.h"

namespace sg::order::methods {
namespace {

// EC for every variable and every entry of a row, from where on wmf pays. Its search takes some microseconds for each; three
// thousand of EC take a tenth of one, and there are graphs, and steps, of a thousand times as many.
constexpr double wmf_pays = 3e3;

double scalars(const graph::Pattern& pattern, const auto& variables) {
  double sum = 0;
  for (const Index j : variables) sum += pattern.dim[j];
  return sum;
}

// Of any order: what the widest row costs, whose variables are a clique whatever goes first; and so, nearly always, are those
// that go last.
double least_ec(const graph::Pattern& pattern, const OrderOptions& options) {
  double widest = scalars(pattern, options.last);
  for (Index r = 0; r < pattern.rows.size(); ++r)
    widest = std::max(widest, scalars(pattern, pattern.rows[r]));
  return widest * widest * widest / 3;
}

}  // namespace

graph::Order quick(const graph::Pattern& pattern, const OrderOptions& options) {
  const double pays =
      wmf_pays * static_cast<double>(pattern.dim.size() + pattern.rows.items.size());
  if (least_ec(pattern, options) > pays) return wmf(pattern, options);
  graph::Order order = colamd(pattern, options);
  const elim::Wide ec = elim::elimination_complexity(pattern, order);
  if (elim::to_double(ec) < pays) return order;
  graph::Order other = wmf(pattern, options);
  return elim::elimination_complexity(pattern, other) < ec ? other : order;
}

}  // namespace sg::order::methods
