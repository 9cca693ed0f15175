#include "lib/prune/steps.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "lib/geometry/numbers.h"
#include "lib/graph/linear.h"
#include "lib/text/error.h"

namespace sg::prune {
namespace {

SE3 estimate(const Graph& graph, Index v) {
  std::vector<double> n;
  graph::vertex_numbers(graph, v, n);
  if (n.size() < 7)
    throw graph::error_at(graph, graph.vertex_line[v], "a pose wants x y z qx qy qz qw");
  return normalized(geometry::se3(n.data()));
}

}  // namespace

void require_fusible(const Graph& graph, Index e, const std::string& which) {
  if (graph.edges_only && graph.edge_tag(e) == graph::EdgeTag::expmap) {
    throw graph::error_at(graph, graph.edge_line[e],
                          "cannot fuse several " + graph.type_of_edge(e).tag + " " + which +
                              " without pose estimates");
  }
}

std::string other_way(const Graph& graph, Index e) {
  return graph::is_linear(graph.edge_tag(e)) ? " (sg-marg takes poses out of linear factors)" : "";
}

void require_composable(const Graph& graph, const graph::Lists<>& odometry, Index k) {
  for (Index e : odometry[k]) {
    const graph::EdgeType& type = graph.type_of_edge(e);
    if (!is_motion(graph.edge_tag(e)) || graph.edge_type[e] != graph.edge_type[odometry[k][0]]) {
      throw graph::error_at(graph, graph.edge_line[e],
                            "cannot compose odometry of type " + type.tag +
                                " across dropped poses" + other_way(graph, e));
    }
    if (odometry[k].size() > 1) require_fusible(graph, e, "of one step");
  }
}

Motion fuse_from(const Graph& graph, const graph::PoseIndex& poses, Index from,
                 const std::vector<Motion>& motions) {
  const bool needs_estimate =
      motions.size() > 1 && std::holds_alternative<ExpmapMotion>(motions[0]);
  return fuse(motions, needs_estimate ? estimate(graph, poses.pose[from]) : SE3{});
}

graph::Lists<> odometry_steps(const Graph& graph, const graph::PoseIndex& poses) {
  std::vector<Index> step(graph.edges(), -1);
  for (Index e = 0; e < graph.edges(); ++e) {
    if (graph::edge_role(graph, poses, e) != graph::EdgeRole::odometry) continue;
    const auto ends = graph.edge(e);
    step[e] = std::max(poses.index[ends[0]], poses.index[ends[1]]);
  }
  return graph::grouped(step, static_cast<Index>(poses.pose.size()));
}

Motion step_motion(const Graph& graph, const graph::PoseIndex& poses,
                   const graph::Lists<>& odometry, Index k) {
  require_composable(graph, odometry, k);
  std::vector<Motion> motions;
  for (Index e : odometry[k]) {
    const Motion forward_or_back = motion(graph, e).value();
    const bool back = graph.edge(e)[0] == poses.pose[k];
    motions.push_back(back ? inverse(forward_or_back) : forward_or_back);
  }
  return fuse_from(graph, poses, k - 1, motions);
}

}  // namespace sg::prune
