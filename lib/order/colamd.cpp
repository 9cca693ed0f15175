// Column approximate minimum degree on the factors themselves: COLAMD (Davis, Gilbert, Larimore,
// Ng, ACM TOMS 30, 2004), in its constrained form CCOLAMD, which iSAM2 uses to keep variables at
// the end.
#include <ccolamd.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <new>
#include <string>
#include <utility>

#include "lib/elim/score.h"
#include "lib/order/constraint.h"
#include "lib/order/methods.h"
#include "lib/text/error.h"

namespace sg::order::methods {
namespace {

// CCOLAMD sets aside "dense" rows and columns to save time, and so orders other graphs badly where
// a pose sees a lot: we want all of them ordered.
void keep_dense(double* knobs) {
  knobs[CCOLAMD_DENSE_ROW] = -1;
  knobs[CCOLAMD_DENSE_COL] = -1;
}

graph::Order ccolamd_order(const graph::Lists<>& rows, Index n, const std::vector<Index>& last) {
  const Index m = rows.size();
  graph::Lists<> a = graph::transpose(rows, n);
  const std::size_t size = ccolamd_recommended(static_cast<int>(a.items.size()), m, n);
  if (size == 0 || size > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw text::computation_error("the graph is too large for CCOLAMD");
  }
  a.items.resize(size);
  double knobs[CCOLAMD_KNOBS];
  ccolamd_set_defaults(knobs);
  keep_dense(knobs);
  int stats[CCOLAMD_STATS];
  std::vector<int> set = constraint_sets(n, last);
  const bool done = ccolamd(m, n, static_cast<int>(size), a.items.data(), a.begin.data(), knobs,
                            stats, set.empty() ? nullptr : set.data());
  if (!done && stats[CCOLAMD_STATUS] == CCOLAMD_ERROR_out_of_memory) throw std::bad_alloc();
  if (!done)
    throw text::computation_error("CCOLAMD failed (status " + std::to_string(stats[3]) + ")");
  a.begin.pop_back();
  return std::move(a.begin);
}

// The order of the variables in that of all vertices, where those that are fixed are columns, too,
// ahead of the others: the order of the graph before anybody fixed them.
graph::Order among_constants(const graph::Pattern& pattern, const std::vector<Index>& last) {
  const Index constants = 1 + std::ranges::max(pattern.constants.items);
  graph::Lists<> rows;
  for (Index r = 0; r < pattern.rows.size(); ++r) {
    if (r < pattern.constants.size())
      std::ranges::copy(pattern.constants[r], std::back_inserter(rows.items));
    for (Index j : pattern.rows[r]) rows.items.push_back(constants + j);
    rows.close();
  }
  std::vector<Index> shifted = last;
  for (Index& j : shifted) j += constants;
  graph::Order order = ccolamd_order(rows, constants + pattern.variables(), shifted);
  std::erase_if(order, [&](Index column) { return column < constants; });
  for (Index& column : order) column -= constants;
  return order;
}

}  // namespace

// CCOLAMD's ties are many, and what it makes of them is chance: where vertices are fixed, there are
// two matrices to ask, and the cheaper answer is taken.
graph::Order colamd(const graph::Pattern& pattern, const OrderOptions& options) {
  graph::Order order = ccolamd_order(pattern.rows, pattern.variables(), options.last);
  if (pattern.constants.items.empty()) return order;
  graph::Order other = among_constants(pattern, options.last);
  const bool cheaper =
      elim::elimination_complexity(pattern, other) < elim::elimination_complexity(pattern, order);
  return cheaper ? other : order;
}

}  // namespace sg::order::methods
