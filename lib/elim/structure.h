// The structure of R, variable by variable: who stands in each separator, where counts.h tells only
// how many.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "lib/elim/etree.h"

namespace sg::elim {

// Calls visit(k, separator) for k = 0, 1, ..., the separator's positions ascending. A separator is
// what the factors of k and the separators of its children in the tree name, k aside (Davis, Direct
// Methods, theorem 4.2); it is kept no longer than its parent needs it.
using VisitSeparator = std::function<void(Index k, std::span<const Index> separator)>;
void visit_separators(const OrderedPattern& pattern, const std::vector<Index>& parent,
                      const VisitSeparator& visit);

}  // namespace sg::elim
