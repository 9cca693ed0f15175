// What `best` (best.cpp) begins with: all other methods of the table, and METIS with ten times the pains, each scored exactly; and
// a few of them polished (polish.h).
//
// Methods that would outlast the budget by what amd took are left out; where amd itself would, a coarse dissection (coarse.h)
// is all there is.
#pragma once

#include "lib/order/best_search.h"

namespace sg::order {

// Takes the best of them.
void take_best_method(Search& search);

}  // namespace sg::order
