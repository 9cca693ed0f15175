// What `best` (best.cpp) goes on with: tries, in rounds of a fixed number that run in parallel, of two kinds:
//
//   - restarts: a pass of greedy_fill (wmf.h) with random ties and jittered scores, given up as
//     soon as it costs more than the best; on a wide graph, also dissections (dissect.h) by other
//     separators;
//   - local improvement. In the elimination tree of the best order a root r is drawn, and a
//     connected region R at the top of its subtree. No front outside R depends on the order inside
//     R, as long as what hangs below R goes before it and what lies above after: what is eliminated
//     by then is the same. So R is a problem of its own (region.h). Greedy passes reorder it, or on
//     a wide graph dissections, and what it gains there the whole order gains. Of one round,
//     improvements whose subtrees are apart are all taken.
//
// A try depends on its number, the seed, and the best order at the start of its round, not on
// threads or time: a budget in tries gives the same order everywhere.
#pragma once

#include "lib/order/best_search.h"

namespace sg::order {

// Tries from the best order so far, as long as the budget lasts.
void take_best_of_tries(Search& search);

}  // namespace sg::order
