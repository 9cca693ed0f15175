#include "lib/graph/linear.h"

namespace sg::graph {

LinearSize linear_size(EdgeTag type, std::span<const Space> ends) {
  LinearSize size{0, type == EdgeTag::linear_relative ? -moving_dim(ends[0]) : 0};
  for (const Space space : ends) {
    size.measurement += space_size(space);
    size.dim += space_dim(space);
  }
  size.measurement += size.dim;
  return size;
}

std::vector<Space> end_spaces(const Graph& graph, Index e) {
  std::vector<Space> spaces;
  for (const Index v : graph.edge(e)) spaces.push_back(graph.type_of_vertex(v).space);
  return spaces;
}

}  // namespace sg::graph
