#include "lib/graph/replay.h"

#include <algorithm>
#include <cassert>

#include "lib/graph/lists.h"

namespace sg::graph {
namespace {

// The last pose index of an edge, -1 where it joins no pose.
Index last_pose(const Graph& graph, const PoseIndex& poses, Index e) {
  Index last = -1;
  for (Index v : graph.edge(e)) last = std::max(last, poses.index[v]);
  return last;
}

// The step that gives every landmark (or other vertex) its min_obs-th observation, -1 where it
// never comes.
void enter_observed(const Graph& graph, const PoseIndex& poses, int min_obs,
                    std::vector<Index>& vertex_step) {
  Lists<> seen = counting_sort(graph.vertices(), [&](const auto& put) {  // steps of observations
    for (Index e = 0; e < graph.edges(); ++e) {
      const Index last = last_pose(graph, poses, e);
      for (Index v : graph.edge(e)) {
        if (last >= 0 && poses.index[v] < 0) put(v, last);
      }
    }
  });
  for (Index v = 0; v < graph.vertices(); ++v) {
    const Index needed = graph.role(v) == Role::landmark ? min_obs : 1;
    if (seen.begin[v + 1] - seen.begin[v] < needed) continue;
    const auto entry = seen.items.begin() + seen.begin[v] + needed - 1;
    std::nth_element(seen.items.begin() + seen.begin[v], entry,
                     seen.items.begin() + seen.begin[v + 1]);
    vertex_step[v] = *entry;
  }
}

// Vertices that only edges without a pose reach enter with the first neighbour that is there: a
// search from the vertices that have a step, earliest first, through those that no pose observes.
void spread(const Graph& graph, const PoseIndex& poses, std::vector<Index>& vertex_step) {
  std::vector<bool> observed(graph.vertices(), false);
  for (Index e = 0; e < graph.edges(); ++e) {
    if (last_pose(graph, poses, e) < 0) continue;
    for (Index v : graph.edge(e)) observed[v] = true;
  }
  const Lists<> incident = counting_sort(graph.vertices(), [&](const auto& put) {
    for (Index e = 0; e < graph.edges(); ++e) {
      if (last_pose(graph, poses, e) >= 0) continue;
      for (Index v : graph.edge(e)) put(v, e);
    }
  });
  std::vector<Index> reached;
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (vertex_step[v] >= 0 && !incident[v].empty()) reached.push_back(v);
  }
  std::ranges::stable_sort(reached, {}, [&](Index v) { return vertex_step[v]; });

  for (const Index source : reached) {
    for (std::vector<Index> stack{source}; !stack.empty();) {
      const Index v = stack.back();
      stack.pop_back();
      for (Index e : incident[v]) {
        for (Index u : graph.edge(e)) {
          if (vertex_step[u] >= 0 || observed[u]) continue;
          vertex_step[u] = vertex_step[v];
          stack.push_back(u);
        }
      }
    }
  }
}

}  // namespace

PoseIndex pose_index(const Graph& graph) {
  PoseIndex poses;
  poses.index.assign(graph.vertices(), -1);
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (graph.role(v) != Role::pose) continue;
    poses.index[v] = static_cast<Index>(poses.pose.size());
    poses.pose.push_back(v);
  }
  return poses;
}

EdgeRole edge_role(const Graph& graph, const PoseIndex& poses, Index e) {
  const auto vertices = graph.edge(e);
  Index pose_count = 0;
  Index landmark_count = 0;
  for (Index v : vertices) {
    pose_count += graph.role(v) == Role::pose;
    landmark_count += graph.role(v) == Role::landmark;
  }
  if (pose_count + landmark_count < static_cast<Index>(vertices.size())) return EdgeRole::other;
  if (pose_count > 0 && landmark_count > 0) return EdgeRole::observation;
  if (pose_count != 2) return EdgeRole::other;
  const Index gap = poses.index[vertices[0]] - poses.index[vertices[1]];
  if (gap == 0) return EdgeRole::other;
  return gap == 1 || gap == -1 ? EdgeRole::odometry : EdgeRole::loop_closure;
}

std::vector<EdgeRole> edge_roles(const Graph& graph, const PoseIndex& poses) {
  std::vector<EdgeRole> roles(graph.edges());
  for (Index e = 0; e < graph.edges(); ++e) roles[e] = edge_role(graph, poses, e);
  return roles;
}

std::vector<Index> segments(const Graph& graph, const PoseIndex& poses) {
  std::vector<bool> continued(poses.pose.size(), false);
  for (Index e = 0; e < graph.edges(); ++e) {
    if (edge_role(graph, poses, e) != EdgeRole::odometry) continue;
    const auto ends = graph.edge(e);
    continued[std::max(poses.index[ends[0]], poses.index[ends[1]])] = true;
  }
  std::vector<Index> first;
  for (Index k = 0; k < static_cast<Index>(poses.pose.size()); ++k) {
    if (!continued[k]) first.push_back(k);
  }
  return first;
}

Replay replay(const Graph& graph, const PoseIndex& poses, int min_obs) {
  assert(min_obs >= 1 && poses.index.size() == graph.id.size());
  Replay result;
  result.steps = static_cast<Index>(poses.pose.size());
  result.vertex_step = poses.index;
  enter_observed(graph, poses, min_obs, result.vertex_step);
  spread(graph, poses, result.vertex_step);
  result.edge_step.assign(graph.edges(), -1);
  for (Index e = 0; e < graph.edges(); ++e) {
    Index step = -1;
    bool all = true;
    for (Index v : graph.edge(e)) {
      all = all && result.vertex_step[v] >= 0;
      step = std::max(step, result.vertex_step[v]);
    }
    if (all) result.edge_step[e] = step;
  }
  return result;
}

void grow(const Graph& graph, const Replay& replay, const std::function<bool(const Grown&)>& show) {
  const Lists<> vertices = grouped(replay.vertex_step, replay.steps);
  const Lists<> edges = grouped(replay.edge_step, replay.steps);
  Grown grown{0, std::vector<bool>(graph.vertices(), false),
              std::vector<bool>(graph.edges(), false)};
  for (; grown.step < replay.steps; ++grown.step) {
    for (const Index v : vertices[grown.step]) grown.vertex_in[v] = true;
    for (const Index e : edges[grown.step]) grown.edge_in[e] = true;
    grown.vertices = vertices.begin[grown.step + 1];
    grown.edges = edges.begin[grown.step + 1];
    if (!show(grown)) return;
  }
}

}  // namespace sg::graph
