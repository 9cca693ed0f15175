// Separators from level structures.
//
// A breadth-first search that starts at one end of a piece (a pseudo-peripheral vertex: George, Liu, An implementation of a
// pseudoperipheral node finder, 1979) meets its vertices level by level, and each level parts what was met before from what
// is yet to come (George, Liu, An automatic nested dissection algorithm for irregular finite element problems, 1978). Of a
// grid in space the levels from a corner are its diagonal planes, three quarters of what an axis' plane has and the
// smallest there are, which multilevel bisection finds by luck alone.
//
// Every prefix of three sequences is priced (price.h), not whole levels alone: by distance from the one end, from the
// other, and by the difference of both. Time O(m).
#pragma once

#include "lib/order/piece.h"
#include "lib/order/price.h"

namespace sg::order {

// The cheapest of them; empty if none leaves two sides. The piece is connected.
Separation level_separation(const Piece& piece, const Prices& prices);

}  // namespace sg::order
