// Column approximate minimum degree on the factors themselves: COLAMD (Davis, Gilbert, Larimore,
// Ng, ACM TOMS 30, 2004), in its constrained form CCOLAMD, which iSAM2 uses to keep variables at
// the end.
#include <ccolamd.h>

#include <limits>
#include <new>
#include <string>
#include <utility>

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

}  // namespace

graph::Order colamd(const graph::Pattern& pattern, const OrderOptions& options) {
  const Index n = pattern.variables();
  const Index m = pattern.rows.size();
  graph::Lists<> a = graph::columns(pattern);
  const std::size_t size = ccolamd_recommended(static_cast<int>(a.items.size()), m, n);
  if (size == 0 || size > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw text::computation_error("the graph is too large for CCOLAMD");
  }
  a.items.resize(size);
  double knobs[CCOLAMD_KNOBS];
  ccolamd_set_defaults(knobs);
  keep_dense(knobs);
  int stats[CCOLAMD_STATS];
  std::vector<int> set = constraint_sets(n, options.last);
  const bool done = ccolamd(m, n, static_cast<int>(size), a.items.data(), a.begin.data(), knobs,
                            stats, set.empty() ? nullptr : set.data());
  if (!done && stats[CCOLAMD_STATUS] == CCOLAMD_ERROR_out_of_memory) throw std::bad_alloc();
  if (!done)
    throw text::computation_error("CCOLAMD failed (status " + std::to_string(stats[3]) + ")");
  a.begin.pop_back();
  return std::move(a.begin);
}

}  // namespace sg::order::methods
