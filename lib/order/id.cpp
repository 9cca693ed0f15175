// Variables are numbered by ascending id: the identity.
#include <numeric>

#include "lib/order/methods.h"

namespace sg::order::methods {

graph::Order id(const graph::Pattern& pattern, const OrderOptions&) {
  graph::Order order(pattern.variables());
  std::iota(order.begin(), order.end(), 0);
  return order;
}

}  // namespace sg::order::methods
