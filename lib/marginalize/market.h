// Topology ec: which measurements between the vertices that stay are worth their elimination complexity.
#pragma once

#include "lib/marginalize/pass.h"

namespace sg::marginalize {

// Passes tell which pairs there could be: a tree's, whose graph has the order in which EC is priced and whose loss a unit
// of EC is the unit of Sparsity::price, and a pass that takes pairs by their worth (prices.h). Both are then fitted over
// the whole graph (whole.h), measurements that are not worth the EC that they cost go, also those of trees where
// others hold together what is recovered (exchange.h), those that are worth it come, and what loses least beside its
// price stays.
// With a budget the price is found by bisection, and what loses least of all within the budget stays.
//
// Where the graph leaves variables undetermined, or no piece may know more than it did, the pass alone counts.
Draft worth_their_ec(const At& at, const std::vector<bool>& removed, const Rule& rule,
                     const Progress& progress);

}  // namespace sg::marginalize
