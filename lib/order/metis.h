// What our own nested dissection takes from METIS.
#pragma once

#include <cstdint>

#include "lib/order/piece.h"

namespace sg::order {

// A vertex separator of a piece without what is around it. One of its sides, or the separator, may be empty.
Separation metis_separation(const Piece& piece, std::uint64_t seed);

}  // namespace sg::order
