#include "lib/order/amd.h"

#include <amd.h>
#include <camd.h>

#include <new>
#include <numeric>
#include <string>

#include "lib/order/constraint.h"
#include "lib/order/methods.h"
#include "lib/text/error.h"

namespace sg::order {
namespace {

void check(int status) {
  if (status == AMD_OUT_OF_MEMORY) throw std::bad_alloc();
  if (status != AMD_OK && status != AMD_OK_BUT_JUMBLED)
    throw text::computation_error("AMD failed (status " + std::to_string(status) + ")");
}

}  // namespace

graph::Order minimum_degree(const graph::Adjacency& graph, const std::vector<Index>& last) {
  const Index n = graph.size();
  const std::vector<int> set = constraint_sets(n, last);
  graph::Order order(n);
  if (graph.items.empty()) {  // AMD takes no empty arrays
    std::iota(order.begin(), order.end(), 0);
  } else if (set.empty()) {
    check(amd_order(n, graph.begin.data(), graph.items.data(), order.data(), nullptr, nullptr));
  } else {
    check(camd_order(n, graph.begin.data(), graph.items.data(), order.data(), nullptr, nullptr,
                     set.data()));
  }
  return order;
}

namespace methods {

graph::Order amd(const graph::Pattern& pattern, const OrderOptions& options) {
  return minimum_degree(graph::adjacency(pattern), options.last);
}

}  // namespace methods
}  // namespace sg::order
