// The orderings themselves, one file each. Callers want order.h, where they have names.
//
// All: a permutation of the pattern's variables; any pattern will do, without variables, without
// rows, with empty rows, in several parts. Throw a computation Error where a library gives up.
#pragma once

#include "lib/order/order.h"

namespace sg::order::methods {

graph::Order amd(const graph::Pattern& pattern, const OrderOptions& options);
graph::Order best(const graph::Pattern& pattern, const OrderOptions& options);
graph::Order colamd(const graph::Pattern& pattern, const OrderOptions& options);
graph::Order file(const graph::Pattern& pattern, const OrderOptions& options);
graph::Order id(const graph::Pattern& pattern, const OrderOptions& options);
graph::Order king(const graph::Pattern& pattern, const OrderOptions& options);
graph::Order landmarks_first(const graph::Pattern& pattern, const OrderOptions& options);
graph::Order metis(const graph::Pattern& pattern, const OrderOptions& options);
graph::Order mmd(const graph::Pattern& pattern, const OrderOptions& options);
graph::Order quick(const graph::Pattern& pattern, const OrderOptions& options);
graph::Order random(const graph::Pattern& pattern, const OrderOptions& options);
graph::Order rcm(const graph::Pattern& pattern, const OrderOptions& options);
graph::Order scotch(const graph::Pattern& pattern, const OrderOptions& options);
graph::Order sloan(const graph::Pattern& pattern, const OrderOptions& options);
graph::Order wmf(const graph::Pattern& pattern, const OrderOptions& options);

}  // namespace sg::order::methods
