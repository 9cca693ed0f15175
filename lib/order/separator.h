// Vertex separators for nested dissection, chosen by what they will cost.
//
// Eliminated after both sides, a separator S meets all outer vertices B of its piece (piece.h), so that with s and b
// their scalar dimensions it costs
//
//     ((s + b)^3 - b^3) / 3,
//
// and each side X is a piece with the outer vertices N(X), those of S among them. What a side will cost is foretold by
// the same formula all the way down: it is halved again and again by separators of c w^gamma for w scalars, and each half
// has half the outer vertices and the separator around it. By this price, not by size and halves, separators compete: on
// a wide graph most is paid for what separators leave around the pieces below them.
//
// They come from METIS (Karypis, Kumar 1998). Each is then replaced by a minimum one near it (vertex_cut.h), for as long
// as that lowers the price.
#pragma once

#include <cstdint>

#include "lib/order/piece.h"

namespace sg::order {

// The cheapest of a few candidates; empty if none leaves two sides.
Separation separation(const Piece& piece, std::uint64_t seed);

}  // namespace sg::order
