// The ordering of the paper's analysis (section on batch elimination): all landmarks, then all
// poses.
#include <algorithm>

#include "lib/order/methods.h"

namespace sg::order::methods {

graph::Order landmarks_first(const graph::Pattern& pattern, const OrderOptions& options) {
  graph::Order order = id(pattern, options);
  if (options.landmark.empty()) return order;
  std::stable_partition(order.begin(), order.end(),
                        [&](Index j) -> bool { return options.landmark[j]; });
  return order;
}

}  // namespace sg::order::methods
