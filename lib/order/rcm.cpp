// Reverse Cuthill-McKee (Cuthill, McKee, ACM 1969; George 1971), Boost.Graph's.
#include <boost/graph/cuthill_mckee_ordering.hpp>

#include "lib/order/boost_graph.h"
#include "lib/order/methods.h"

namespace sg::order::methods {
namespace {

graph::Order order_part(const ConnectedPart& part) {
  const BoostGraph graph = boost_graph(part.adjacency);
  graph::Order order(part.adjacency.size());
  boost::cuthill_mckee_ordering(graph, order.rbegin());
  return order;
}

}  // namespace

graph::Order rcm(const graph::Pattern& pattern, const OrderOptions&) {
  return order_by_parts(pattern, order_part);
}

}  // namespace sg::order::methods
