// The orderings themselves, one file each. Callers want order.h, where they have names.
//
// All: a permutation of the pattern's variables; any pattern will do, without variables, without
// rows, with empty rows, in several parts. Throw a computation Error where a library gives up.
#pragma once

#include "lib/order/order.h"

namespace sg::ordering {

Order amd(const Pattern& pattern, const OrderOptions& options);
Order best(const Pattern& pattern, const OrderOptions& options);
Order colamd(const Pattern& pattern, const OrderOptions& options);
Order file(const Pattern& pattern, const OrderOptions& options);
Order id(const Pattern& pattern, const OrderOptions& options);
Order king(const Pattern& pattern, const OrderOptions& options);
Order landmarks_first(const Pattern& pattern, const OrderOptions& options);
Order metis(const Pattern& pattern, const OrderOptions& options);
Order mmd(const Pattern& pattern, const OrderOptions& options);
Order random(const Pattern& pattern, const OrderOptions& options);
Order rcm(const Pattern& pattern, const OrderOptions& options);
Order scotch(const Pattern& pattern, const OrderOptions& options);
Order sloan(const Pattern& pattern, const OrderOptions& options);
Order wmf(const Pattern& pattern, const OrderOptions& options);

}  // namespace sg::ordering
