// Sloan's ordering for a small profile and wavefront (Sloan, Int. J. Numer. Methods Eng. 23, 1986),
// Boost.Graph's, between the ends of a pseudo-diameter that Boost's search for RCM finds. (Its
// search for Sloan writes past an array where the last level holds a vertex of largest degree.)
#include <boost/graph/sloan_ordering.hpp>
// after the line above, which needs it and does not include it
#include <boost/graph/cuthill_mckee_ordering.hpp>
#include <boost/graph/properties.hpp>

#include "lib/order/boost_graph.h"
#include "lib/order/methods.h"

namespace sg::order::methods {
namespace {

graph::Order order_part(const ConnectedPart& part) {
  BoostGraph graph = boost_graph(part.adjacency);
  const std::size_t n = boost::num_vertices(graph);
  std::vector<boost::default_color_type> color(n, boost::white_color);
  std::vector<int> degree(n);
  for (std::size_t v = 0; v < n; ++v) degree[v] = static_cast<int>(boost::out_degree(v, graph));
  std::vector<double> priority(n);
  const auto color_map = vertex_map(color, graph);
  const auto degree_map = vertex_map(degree, graph);
  const auto start = boost::find_starting_node(graph, std::size_t{0}, color_map, degree_map);
  int eccentricity = 0;
  const auto end = boost::pseudo_peripheral_pair(graph, start, eccentricity, color_map, degree_map);
  graph::Order order(n);
  boost::sloan_ordering(graph, start, end, order.begin(), color_map, degree_map,
                        vertex_map(priority, graph));
  return order;
}

}  // namespace

graph::Order sloan(const graph::Pattern& pattern, const OrderOptions&) {
  return order_by_parts(pattern, order_part);
}

}  // namespace sg::order::methods
