#include "lib/order/parts.h"

#include <algorithm>

namespace sg::order {
namespace {

// The variables that can be reached from `first`, ascending; marks them in `seen`.
std::vector<Index> reachable(const graph::Adjacency& graph, Index first, std::vector<bool>& seen) {
  std::vector<Index> found{first};
  seen[first] = true;
  for (std::size_t k = 0; k < found.size(); ++k) {
    for (Index i : graph[found[k]]) {
      if (!seen[i]) found.push_back(i);
      seen[i] = true;
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

// `number` is scratch space of n.
ConnectedPart part_of(const graph::Pattern& pattern, const graph::Adjacency& graph,
                      const std::vector<Index>& variables, std::vector<Index>& number) {
  ConnectedPart part;
  for (std::size_t k = 0; k < variables.size(); ++k) {
    number[variables[k]] = static_cast<Index>(k);
    part.dim.push_back(pattern.dim[variables[k]]);
  }
  for (Index j : variables) {
    for (Index i : graph[j]) part.adjacency.items.push_back(number[i]);
    part.adjacency.close();
  }
  return part;
}

}  // namespace

graph::Order order_by_parts(const graph::Pattern& pattern,
                            const std::function<graph::Order(ConnectedPart&)>& order_part) {
  const Index n = pattern.variables();
  const graph::Adjacency graph = graph::adjacency(pattern);
  std::vector<bool> seen(n, false);
  std::vector<Index> number(n);
  graph::Order order;
  order.reserve(n);
  for (Index j = 0; j < n; ++j) {
    if (seen[j]) continue;
    const std::vector<Index> variables = reachable(graph, j, seen);
    if (variables.size() == 1) {
      order.push_back(j);
      continue;
    }
    ConnectedPart part = part_of(pattern, graph, variables, number);
    for (Index k : order_part(part)) order.push_back(variables[k]);
  }
  return order;
}

}  // namespace sg::order
