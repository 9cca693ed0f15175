#include "lib/prune/candidates.h"

#include <algorithm>

namespace sg::prune {
namespace {

// An edge that lets a pose see a landmark. Wider than the role `observation`: a vertex that is
// neither may take part in it.
bool observes(const Graph& graph, const graph::PoseIndex& poses, Index e) {
  const auto ends = graph.edge(e);
  return std::any_of(ends.begin(), ends.end(), [&](Index v) { return poses.index[v] >= 0; });
}

struct Observations {
  std::vector<Index> count;    // of every vertex, as pruning leaves them
  std::vector<bool> observed;  // of every vertex, whether the input observes it
};
Observations count_observations(const Graph& graph, const graph::PoseIndex& poses,
                                const Removal& removal) {
  Observations result{std::vector<Index>(graph.vertices(), 0),
                      std::vector<bool>(graph.vertices(), false)};
  for (Index e = 0; e < graph.edges(); ++e) {
    if (!observes(graph, poses, e)) continue;
    for (Index v : graph.edge(e)) {
      result.observed[v] = true;
      if (!removal.edge[e]) ++result.count[v];
    }
  }
  return result;
}

}  // namespace

Candidates natural_candidates(const Graph& graph) {
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (graph.role(v) == graph::Role::landmark) return Candidates::observations;
  }
  return Candidates::loops;
}

Candidates candidates_named(std::string_view name, const Graph& graph) {
  if (name.empty()) return natural_candidates(graph);
  if (name == "observations") return Candidates::observations;
  if (name == "loops") return Candidates::loops;
  if (name == "both") return Candidates::both;
  throw text::usage_error("candidates: observations, loops or both, not '" + std::string(name) +
                          "'");
}

std::vector<Index> candidate_edges(const Graph& graph, const graph::PoseIndex& poses,
                                   Candidates kind) {
  std::vector<Index> edges;
  for (Index e = 0; e < graph.edges(); ++e) {
    const graph::EdgeRole role = graph::edge_role(graph, poses, e);
    if ((role == graph::EdgeRole::observation && kind != Candidates::loops) ||
        (role == graph::EdgeRole::loop_closure && kind != Candidates::observations)) {
      edges.push_back(e);
    }
  }
  return edges;
}

Removal nothing_removed(const Graph& graph) {
  return {std::vector<bool>(graph.vertices(), false), std::vector<bool>(graph.edges(), false)};
}

Removal removal_of_rest(const Graph& graph, const std::vector<Index>& candidates,
                        const std::vector<bool>& kept) {
  Removal removal = nothing_removed(graph);
  for (std::size_t i = 0; i < candidates.size(); ++i) removal.edge[candidates[i]] = !kept[i];
  return removal;
}

void sweep_landmarks(const Graph& graph, const graph::PoseIndex& poses, Index min_obs,
                     Removal& removal) {
  Observations seen = count_observations(graph, poses, removal);
  const auto swept = [&](Index v) {
    return graph.role(v) == graph::Role::landmark && !removal.vertex[v] && seen.observed[v] &&
           seen.count[v] < min_obs;
  };
  // Not what joins dropped poses: that may be rewritten to join others.
  const auto swept_away = [&](Index v) {
    return graph.role(v) == graph::Role::landmark && removal.vertex[v];
  };
  // An edge of several landmarks takes an observation from all of them when one leaves: again,
  // then, until nothing changes.
  for (bool changed = true; changed;) {
    changed = false;
    for (Index v = 0; v < graph.vertices(); ++v) {
      if (!swept(v)) continue;
      removal.vertex[v] = true;
      changed = true;
    }
    if (!changed) return;
    for (Index e = 0; e < graph.edges(); ++e) {
      const auto ends = graph.edge(e);
      if (removal.edge[e] || std::none_of(ends.begin(), ends.end(), swept_away)) continue;
      removal.edge[e] = true;
      if (!observes(graph, poses, e)) continue;
      for (Index v : ends) --seen.count[v];
    }
  }
}

}  // namespace sg::prune
