// Variables are numbered by ascending id: the identity.
#include <numeric>

#include "lib/order/methods.h"

namespace sg::ordering {

Order id(const Pattern& pattern, const OrderOptions&) {
  Order order(pattern.variables());
  std::iota(order.begin(), order.end(), 0);
  return order;
}

}  // namespace sg::ordering
