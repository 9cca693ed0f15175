// Multiple minimum degree (George, Liu, SIAM Review 31, 1989), Boost.Graph's.
#include <boost/graph/minimum_degree_ordering.hpp>

#include "lib/order/boost_graph.h"
#include "lib/order/methods.h"

namespace sg::order::methods {
namespace {

// Boost looks one place beyond its lists by degree when vertices of the largest degree possible go.
// A vertex without neighbours, which goes first and costs nothing, makes the lists longer by one.
graph::Order order_part(const ConnectedPart& part) {
  BoostGraph graph = boost_graph(part.adjacency);
  const auto lone = static_cast<Index>(boost::add_vertex(graph));
  const auto n = boost::num_vertices(graph);
  std::vector<int> degree(n, 0);
  std::vector<int> position(n, 0);
  std::vector<int> supernode_size(n, 1);
  graph::Order order(n, 0);
  boost::minimum_degree_ordering(graph, vertex_map(degree, graph), position.data(), order.data(),
                                 vertex_map(supernode_size, graph), 0,
                                 boost::get(boost::vertex_index, graph));
  std::erase(order, lone);
  return order;
}

}  // namespace

graph::Order mmd(const graph::Pattern& pattern, const OrderOptions&) {
  return order_by_parts(pattern, order_part);
}

}  // namespace sg::order::methods
