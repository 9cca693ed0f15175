// A separator made cheaper vertex by vertex.
//
// One of its vertices goes over to a side, and its neighbours on the other side come into the separator instead. Of the
// two best by what the separator loses in weight, one a side, the cheaper goes (price.h), also where the price rises; the
// best that was seen on the way is kept (Fiduccia, Mattheyses 1982; for separators: Ashcraft, Liu 1996; Hendrickson, Rothberg
// 1998). A pass looks at the separator and what is near it, not at the whole piece.
#pragma once

#include "lib/order/price.h"

namespace sg::order {

// patience: so many moves without a better price end a pass. Returns the price.
double refine(const Piece& piece, const Prices& prices, int passes, int patience, Separation& side);

}  // namespace sg::order
