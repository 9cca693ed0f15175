// What our own nested dissection takes from METIS.
#pragma once

#include <cstdint>

#include "lib/order/order.h"
#include "lib/order/piece.h"

namespace sg::order {

// A vertex separator of a piece without what is around it. One of its sides, or the separator, may be empty.
Separation metis_separation(const Piece& piece, std::uint64_t seed);

// The ordering `metis` with 20 separators tried and 100 rounds of refinement at every level, in some ten times its time.
graph::Order tuned_metis(const graph::Pattern& pattern, const OrderOptions& options);

}  // namespace sg::order
