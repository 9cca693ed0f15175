// What elimination complexity would lose without a row of A, under the same order: the price of an edge.
//
// Say p is the first variable of the row to be eliminated. Without the row those of its others leave p's separator that
// nothing else brings there: no other row that starts with p, and no child of p in the elimination tree. What p then no
// longer brings to its parent may leave the parent's separator, and so on up the tree. A variable whose parent has left
// its separator hangs on the next in it, further up the same path, and brings its separator there instead. The walk
// ends where nothing leaves and nothing hangs elsewhere than before.
//
// EC never rises when a row goes (Frey, Steiner, How, Lemma 1). A row of price 0 is free: others bring all that it does.
#pragma once

#include <vector>

#include "lib/elim/score.h"

namespace sg::elim {

// Of every row: EC(pattern) - EC(pattern without it), exact. Takes the space of R's block structure, and for a row the
// time of the path that it changes.
std::vector<Wide> row_prices(const graph::Pattern& pattern, const graph::Order& order);

}  // namespace sg::elim
