// Variables that come last.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "lib/graph/pattern.h"

namespace sg::order {

// Constraint sets as CCOLAMD and CAMD take them. Of every variable: 1 if it is one of `last`, 0 if not. Empty where this constrains nothing, that
// is, for none or all of the variables.
inline std::vector<int> constraint_sets(Index n, const std::vector<Index>& last) {
  std::vector<int> set(n, 0);
  Index ones = 0;
  for (Index j : last) ones += 1 - std::exchange(set.at(j), 1);
  if (ones == 0 || ones == n) set.clear();
  return set;
}

// In their relative order. Throws std::out_of_range where one of them is not in the order.
inline void move_to_end(graph::Order& order, const std::vector<Index>& last) {
  std::vector<bool> is_last(order.size(), false);
  for (const Index j : last) is_last.at(j) = true;
  std::stable_partition(order.begin(), order.end(), [&](Index j) { return !is_last[j]; });
}

}  // namespace sg::order
