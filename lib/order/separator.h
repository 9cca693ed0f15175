// Vertex separators for nested dissection, chosen by what they will cost (price.h).
//
// They come from METIS (Karypis, Kumar 1998), one of a small piece, up to three of one that will cost much, and from level
// structures (levels.h). Each is made cheaper vertex by vertex (refine.h), and the cheapest of them is then replaced by a
// minimum one near it (vertex_cut.h), if that lowers the price.
#pragma once

#include <cstdint>

#include "lib/order/piece.h"

namespace sg::order {

// The cheapest that was found; empty if none leaves two sides.
Separation separation(const Piece& piece, std::uint64_t seed);

}  // namespace sg::order
