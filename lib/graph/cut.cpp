#include "lib/graph/cut.h"

#include <algorithm>

#include "lib/graph/components.h"

namespace sg::graph {
namespace {

// The edges all of whose vertices are in the part.
void add_edges(const Graph& graph, Part& part) {
  part.edge.resize(graph.edges());
  for (Index e = 0; e < graph.edges(); ++e) {
    const auto ends = graph.edge(e);
    part.edge[e] = std::all_of(ends.begin(), ends.end(), [&](Index v) { return part.vertex[v]; });
  }
}

Part component(const Graph& graph, const Components& components, Index wanted) {
  Part part;
  for (const Index number : components.of) part.vertex.push_back(number == wanted);
  add_edges(graph, part);
  return part;
}

}  // namespace

Part first_steps(const Graph& graph, const PoseIndex& poses, Index steps, int min_obs) {
  const Replay steps_of = replay(graph, poses, min_obs);
  const auto before = [steps](Index step) { return step >= 0 && step < steps; };
  Part part;
  for (const Index step : steps_of.vertex_step) part.vertex.push_back(before(step));
  for (const Index step : steps_of.edge_step) part.edge.push_back(before(step));
  return part;
}

Part pose_range(const Graph& graph, const PoseIndex& poses, Index first, Index last) {
  const auto inside = [&](Index v) { return poses.index[v] >= first && poses.index[v] <= last; };
  Part part;
  for (Index v = 0; v < graph.vertices(); ++v) part.vertex.push_back(inside(v));
  for (Index e = 0; e < graph.edges(); ++e) {
    const auto ends = graph.edge(e);
    const bool kept = std::any_of(ends.begin(), ends.end(), inside) &&
                      std::all_of(ends.begin(), ends.end(),
                                  [&](Index v) { return poses.index[v] < 0 || inside(v); });
    for (Index v : ends) part.vertex[v] = part.vertex[v] || kept;
  }
  add_edges(graph, part);
  return part;
}

Part component_of(const Graph& graph, Index v) {
  const Components all = components(graph);
  return component(graph, all, all.of[v]);
}

Part largest_component(const Graph& graph) {
  const Components all = components(graph);
  const std::vector<Index> size = sizes(all);
  const auto largest = std::max_element(size.begin(), size.end());
  return component(graph, all, static_cast<Index>(largest - size.begin()));
}

Part of_ids(const Graph& graph, const std::vector<std::pair<Id, Id>>& ranges) {
  Part part;
  for (const Id id : graph.id) {
    part.vertex.push_back(std::any_of(ranges.begin(), ranges.end(), [id](const auto& range) {
      return range.first <= id && id <= range.second;
    }));
  }
  add_edges(graph, part);
  return part;
}

Part of_types(const Graph& graph, const Types& types) {
  Part part;
  for (const TypeIndex type : graph.vertex_type) part.vertex.push_back(types.vertex[type]);
  add_edges(graph, part);
  for (Index e = 0; e < graph.edges(); ++e) {
    if (!types.edge[graph.edge_type[e]]) continue;
    part.edge[e] = true;
    for (const Index v : graph.edge(e)) part.vertex[v] = true;
  }
  return part;
}

Part without_types(const Graph& graph, const Types& types) {
  Part part;
  for (const TypeIndex type : graph.vertex_type) part.vertex.push_back(!types.vertex[type]);
  add_edges(graph, part);
  std::vector<bool> had(graph.vertices(), false), has(graph.vertices(), false);
  for (Index e = 0; e < graph.edges(); ++e) {
    part.edge[e] = part.edge[e] && !types.edge[graph.edge_type[e]];
    for (const Index v : graph.edge(e)) {
      had[v] = true;
      has[v] = has[v] || part.edge[e];
    }
  }
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (graph.role(v) != Role::pose && had[v] && !has[v]) part.vertex[v] = false;
  }
  return part;
}

}  // namespace sg::graph
