#include "lib/order/parts.h"

#include "lib/graph/components.h"

namespace sg::order {
namespace {

// `number` is scratch space of n.
Part part_of(const graph::Pattern& pattern, const graph::Adjacency& graph,
             std::span<const Index> variables, std::vector<Index>& number) {
  Part part;
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
                            const std::function<graph::Order(Part&)>& order_part) {
  const Index n = pattern.variables();
  const graph::Adjacency graph = graph::adjacency(pattern);
  const graph::Components parts = graph::components(pattern.rows, n);
  std::vector<Index> number(n);
  graph::Order order;
  order.reserve(n);
  const graph::Lists<> members = graph::grouped(parts.of, parts.count);
  for (Index c = 0; c < parts.count; ++c) {
    const auto variables = members[c];
    if (variables.size() == 1) {
      order.push_back(variables.front());
      continue;
    }
    Part part = part_of(pattern, graph, variables, number);
    for (Index k : order_part(part)) order.push_back(variables[k]);
  }
  return order;
}

}  // namespace sg::order
