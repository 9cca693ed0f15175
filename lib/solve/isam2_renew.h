// When to order the whole tree anew.
//
// What iSAM2 orders anew is the top of the tree alone, and of what it has ordered before every part is as good as it was
// then. Over time EC_BT may drift away from what an ordering of the whole would give. To know by how much takes that
// ordering; it is asked for when EC_BT has grown by a tenth since the last time.
#pragma once

#include "lib/solve/isam2.h"

namespace sg::solve {

struct Renewal {
  double factor = 0;      // above 1; 0: never
  elim::Wide budget = 0;  // a whole that would cost more is not eliminated at once; 0: any
  elim::Wide asked = 0;   // EC_BT when that was last asked
};

// Whether EC_BT is above `factor` times the EC of the whole in a fresh order.
bool is_worn(const Isam2& isam, Renewal& renewal);

}  // namespace sg::solve
