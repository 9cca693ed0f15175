// A part of the block graph as Boost.Graph's orderings want it: directed, each edge both ways,
// neighbours ascending.
#pragma once

#include <boost/graph/adjacency_list.hpp>
#include <vector>

#include "lib/order/parts.h"

namespace sg::order {

using BoostGraph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS>;

inline BoostGraph boost_graph(const graph::Adjacency& adjacency) {
  BoostGraph graph(adjacency.size());
  for (Index j = 0; j < adjacency.size(); ++j) {
    for (Index i : adjacency[j]) boost::add_edge(j, i, graph);
  }
  return graph;
}

// Storage that Boost's algorithms see as a map from the vertex.
template <class Value>
auto vertex_map(std::vector<Value>& values, const BoostGraph& graph) {
  return boost::make_iterator_property_map(values.begin(), boost::get(boost::vertex_index, graph));
}

}  // namespace sg::order
