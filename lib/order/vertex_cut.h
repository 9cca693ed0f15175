// A minimum separator near another.
//
// Around a separator lies a band of what is nearest to it on either side. Of all separators within the band that keep
// apart what is left beyond it, one of the least weight is found as a maximum flow from one end to the other, every
// vertex passing on no more than it weighs (Menger 1927; Ford, Fulkerson 1956), by Dinic's algorithm (1970). That this
// makes good separators better is known from graph partitioning (Sanders, Schulz, Advanced multilevel node separator
// algorithms, SEA 2016).
#pragma once

#include <array>
#include <cstdint>

#include "lib/order/piece.h"

namespace sg::order {

// Of the minimum separators in the band, the one nearest to side 0 and the one nearest to side 1. room: how much
// weight of each side the band may take in; less than all of it.
std::array<Separation, 2> minimum_separations(const Piece& piece, const Separation& side,
                                              const std::array<std::int64_t, 2>& room);

}  // namespace sg::order
