#include "lib/prune/covisible.h"

#include <algorithm>
#include <set>

namespace sg::prune {
namespace {

// By pose index: the landmarks that a pose sees, as vertices, each once.
graph::Lists<> landmarks_in_view(const Graph& graph, const graph::PoseIndex& poses) {
  std::vector<std::set<Index>> seen(poses.pose.size());
  for (Index e = 0; e < graph.edges(); ++e) {
    if (graph::edge_role(graph, poses, e) != graph::EdgeRole::observation) continue;
    for (const Index v : graph.edge(e)) {
      if (poses.index[v] < 0) continue;
      for (const Index l : graph.edge(e)) {
        if (graph.role(l) == graph::Role::landmark) seen[poses.index[v]].insert(l);
      }
    }
  }
  graph::Lists<> result;
  for (const auto& landmarks : seen) {
    result.items.insert(result.items.end(), landmarks.begin(), landmarks.end());
    result.close();
  }
  return result;
}

}  // namespace

std::vector<bool> covisible_keyframes(const Graph& graph, const graph::PoseIndex& poses,
                                      const graph::Lists<>& odometry, const CovisibleRule& rule) {
  const graph::Lists<> in_view = landmarks_in_view(graph, poses);
  std::vector<bool> keyframe(poses.pose.size(), true);
  std::vector<std::vector<Index>> observers(
      graph.vertices());  // keyframes so far, of every landmark
  const auto must_stay = [&](Index k) { return odometry[k].empty() || graph.fixed[poses.pose[k]]; };
  const auto is_redundant = [&](Index k) {
    const auto known = std::ranges::count_if(in_view[k], [&](Index l) {
      return static_cast<Index>(observers[l].size()) - 1 >= rule.others;
    });
    return static_cast<double>(known) >= rule.part * static_cast<double>(in_view[k].size());
  };
  for (Index k = 0; k < in_view.size(); ++k) {
    std::set<Index> covisible;
    for (const Index l : in_view[k]) {
      covisible.insert(observers[l].begin(), observers[l].end());
      observers[l].push_back(k);
    }
    for (const Index j : covisible) {
      if (must_stay(j) || !is_redundant(j)) continue;
      keyframe[j] = false;
      for (const Index l : in_view[j]) std::erase(observers[l], j);
    }
  }
  return keyframe;
}

}  // namespace sg::prune
