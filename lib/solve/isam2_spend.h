// What a budget is spent on where poses are composed, too: whatever loses least per EC that it frees.
//
// Loss is by how much the sum of the variances of positions will be larger for it (isam2_admit.h):
//
//   the oldest pose leaves    what edges will come back to it and would have told (isam2_returns.h), is lost; what it knows
//                             is not, since it is marginalized;
//   a pose is composed        its observations are given back: what that loses now; and of what edges will come back to it
//                             the share of the way from its host in the variance of a closure from there;
//   a closure is refused      its gain; what it would add to EC_BT is what that frees.
//
// What a pose stands for counts as often as it stands for others. While a step is above the budget, the cheaper of the first
// two is done; a closure is refused if its rate is below the last one at which room was made. So poses leave by age, at
// no loss, where no way leads back; where one does, the past is thinned out, the old and what lies close first.
#pragma once

#include "lib/solve/isam2_turns.h"

namespace sg::solve {

// Before an update: leaves closures out of what enters that are not worth it.
void refuse_closures(Isam2Window& window, Entering& entering, Index k);

// As plan_within, and poses are composed.
CliqueTree plan_spending(Isam2Window& window, const Entering& entering, Index k, Index least,
                         Leaving& leaving);

// After an update: learns from what has come in, and from what named what has left.
void learn(Isam2Window& window);

}  // namespace sg::solve
