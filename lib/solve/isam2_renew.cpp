#include "lib/solve/isam2_renew.h"

#include "lib/solve/clique_tree.h"
#include "lib/solve/snapshot.h"

namespace sg::solve {

bool is_worn(const Isam2& isam, Renewal& renewal) {
  const elim::Wide now = isam.tree.ec_bt;
  if (renewal.factor <= 0 || static_cast<double>(now) < 1.1 * static_cast<double>(renewal.asked))
    return false;
  renewal.asked = now;
  Snapshot snapshot;
  take_snapshot(isam, false, snapshot);
  order::OrderOptions options;
  options.budget = isam.options.order_budget;
  const graph::Order order =
      order::elimination_order(isam.options.ordering, snapshot.pattern, options);
  const CliqueTree tree = clique_tree(snapshot.pattern, order, never);
  elim::Wide fresh = 0;
  for (const std::int64_t ec : tree.ec) fresh += static_cast<elim::Wide>(ec);
  if (renewal.budget > 0 && fresh > renewal.budget) return false;
  return static_cast<double>(now) > renewal.factor * static_cast<double>(fresh);
}

}  // namespace sg::solve
