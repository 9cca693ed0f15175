// Constraint sets as CCOLAMD and CAMD take them.
#pragma once

#include <utility>
#include <vector>

#include "lib/graph/pattern.h"

namespace sg::order {

// Of every variable: 1 if it is one of `last`, 0 if not. Empty where this constrains nothing, that
// is, for none or all of the variables.
inline std::vector<int> constraint_sets(Index n, const std::vector<Index>& last) {
  std::vector<int> set(n, 0);
  Index ones = 0;
  for (Index j : last) ones += 1 - std::exchange(set.at(j), 1);
  if (ones == 0 || ones == n) set.clear();
  return set;
}

}  // namespace sg::order
