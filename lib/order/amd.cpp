// Approximate minimum degree on the block graph (Amestoy, Davis, Duff, ACM TOMS 30, 2004), every
// variable weighing one; CAMD where variables are constrained to the end.
#include <amd.h>
#include <camd.h>

#include <new>
#include <string>

#include "lib/order/constraint.h"
#include "lib/order/methods.h"
#include "lib/text/error.h"

namespace sg::order::methods {
namespace {

void check(int status) {
  if (status == AMD_OUT_OF_MEMORY) throw std::bad_alloc();
  if (status != AMD_OK)
    throw text::computation_error("AMD failed (status " + std::to_string(status) + ")");
}

}  // namespace

graph::Order amd(const graph::Pattern& pattern, const OrderOptions& options) {
  const Index n = pattern.variables();
  const graph::Adjacency graph = graph::adjacency(pattern);
  if (graph.items.empty()) return id(pattern, options);  // AMD takes no empty arrays
  const std::vector<int> set = constraint_sets(n, options.last);
  graph::Order order(n);
  if (set.empty()) {
    check(amd_order(n, graph.begin.data(), graph.items.data(), order.data(), nullptr, nullptr));
  } else {
    check(camd_order(n, graph.begin.data(), graph.items.data(), order.data(), nullptr, nullptr,
                     set.data()));
  }
  return order;
}

}  // namespace sg::order::methods
