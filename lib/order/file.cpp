// The order in which the file lists its vertices.
#include "lib/order/methods.h"

namespace sg::order::methods {

graph::Order file(const graph::Pattern& pattern, const OrderOptions& options) {
  return options.file_order.empty() ? id(pattern, options) : options.file_order;
}

}  // namespace sg::order::methods
