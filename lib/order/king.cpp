// King's ordering for a small profile (King, Int. J. Numer. Methods Eng. 2, 1970), Boost.Graph's,
// reversed: a small front on the way in is a small separator on the way out.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored \
    "-Wmaybe-uninitialized"  // Boost's visitor is copied before it starts
#include <boost/graph/king_ordering.hpp>
#pragma GCC diagnostic pop

#include "lib/order/boost_graph.h"
#include "lib/order/methods.h"

namespace sg::order::methods {
namespace {

graph::Order order_part(const ConnectedPart& part) {
  const BoostGraph graph = boost_graph(part.adjacency);
  graph::Order order(part.adjacency.size());
  boost::king_ordering(graph, order.rbegin());
  return order;
}

}  // namespace

graph::Order king(const graph::Pattern& pattern, const OrderOptions&) {
  return order_by_parts(pattern, order_part);
}

}  // namespace sg::order::methods
