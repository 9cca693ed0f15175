#include "lib/graph/summary.h"

#include <algorithm>

#include "lib/graph/components.h"
#include "lib/graph/linear.h"
#include "lib/graph/replay.h"

namespace sg::graph {
namespace {

void count_vertices(const Graph& graph, Summary& summary) {
  for (Index v = 0; v < graph.vertices(); ++v) {
    summary.poses += graph.role(v) == Role::pose;
    summary.landmarks += graph.role(v) == Role::landmark;
    summary.others += graph.role(v) == Role::other;
    summary.fixed += graph.fixed[v];
    summary.dim += graph.fixed[v] ? 0 : graph.dim(v);
  }
}

std::int64_t rows_of(const Graph& graph, Index e) {
  const EdgeType& type = graph.type_of_edge(e);
  if (is_linear(graph.edge_tag(e))) return linear_size(graph.edge_tag(e), end_spaces(graph, e)).dim;
  if (!type.counted) return std::max(type.dim, 0);
  return std::max(type.measurement, 0) * (static_cast<std::int64_t>(graph.edge(e).size()) - 1);
}

void count_edges(const Graph& graph, Summary& summary) {
  const PoseIndex poses = pose_index(graph);
  summary.segments = static_cast<Index>(segments(graph, poses).size());
  for (Index e = 0; e < graph.edges(); ++e) {
    const EdgeRole role = edge_role(graph, poses, e);
    summary.odometry += role == EdgeRole::odometry;
    summary.loop_closures += role == EdgeRole::loop_closure;
    summary.observations += role == EdgeRole::observation;
    summary.other_edges += role == EdgeRole::other;
    summary.rows += rows_of(graph, e);
    if (role != EdgeRole::observation) continue;
    for (Index v : graph.edge(e)) summary.sights += graph.role(v) == Role::landmark;
  }
}

void count_degrees(const Graph& graph, Summary& summary) {
  std::vector<Index> degree(graph.vertices(), 0);
  for (Index v : graph.edge_vertices.items) ++degree[v];
  summary.isolated = static_cast<Index>(std::count(degree.begin(), degree.end(), 0));
  if (!degree.empty()) summary.max_degree = *std::max_element(degree.begin(), degree.end());
}

}  // namespace

Summary summarize(const Graph& graph) {
  Summary summary;
  count_vertices(graph, summary);
  count_edges(graph, summary);
  count_degrees(graph, summary);
  summary.components = components(graph).count;
  return summary;
}

std::optional<double> average_observations(const Graph& graph) {
  std::int64_t landmarks = 0, observations = 0;
  for (Index v = 0; v < graph.vertices(); ++v) landmarks += graph.role(v) == Role::landmark;
  for (Index e = 0; e < graph.edges(); ++e) {
    std::int64_t of_edge = 0;
    bool pose = false;
    for (Index v : graph.edge(e)) {
      of_edge += graph.role(v) == Role::landmark;
      pose = pose || graph.role(v) == Role::pose;
    }
    if (pose) observations += of_edge;
  }
  if (landmarks == 0) return std::nullopt;
  return static_cast<double>(observations) / static_cast<double>(landmarks);
}

}  // namespace sg::graph
