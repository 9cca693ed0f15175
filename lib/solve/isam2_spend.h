// What a budget is spent on where poses are composed: whatever loses least.
//
// Loss is by how much the sum of the variances of positions will be larger for it:
//
//   a pose is composed        all that it stands for hang on the way from its host then: so many times the variance of the
//                             way, with the longest that they had before. Always taking the least of these thins the past
//                             out evenly, as a fixed rate would, and ever further as the budget fills;
//   the oldest pose leaves    what edges will come back to it and would have told is lost; what it knows is not, since it
//                             is marginalized, and the observations that composing would have given back are kept.
//
// `keyframes` composes, and lets poses go by age where none can be composed. `mixed` lets the oldest go while what is
// expected to come back to it (isam2_returns.h) is less than a tenth of what it observes, or next to nothing, and that is
// enough; it composes otherwise, or where landmarks are seen along rays: marginalized before they have been seen from afar,
// they would be linear in poor points.
#pragma once

#include "lib/solve/isam2_turns.h"

namespace sg::solve {

// As plan_within, and poses are composed.
CliqueTree plan_spending(Isam2Window& window, const Entering& entering, Index k, Index least,
                         Leaving& leaving);

// After an update: notes how old what the step's edges named was.
void learn(Isam2Window& window);

}  // namespace sg::solve
