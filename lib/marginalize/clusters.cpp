#include "lib/marginalize/clusters.h"

#include "lib/graph/components.h"
#include "lib/graph/replay.h"

namespace sg::marginalize {
namespace {

// The removed vertices that edges connect.
std::vector<std::vector<Index>> connected(const Graph& graph, const std::vector<bool>& removed) {
  graph::DisjointSets parts(graph.vertices());
  for (Index e = 0; e < graph.edges(); ++e) {
    Index first = -1;
    for (const Index v : graph.edge(e)) {
      if (!removed[v]) continue;
      if (first >= 0) join(parts, first, v);
      first = v;
    }
  }
  std::vector<Index> part(graph.vertices(), -1);
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (removed[v]) part[v] = find(parts, v);
  }
  const graph::Lists<> lists = graph::grouped(part, graph.vertices());
  std::vector<std::vector<Index>> result;
  for (Index k = 0; k < lists.size(); ++k) {
    if (!lists[k].empty()) result.emplace_back(lists[k].begin(), lists[k].end());
  }
  return result;
}

}  // namespace

std::vector<std::vector<Index>> clusters(const Graph& graph, const std::vector<bool>& removed,
                                         Clusters kind) {
  if (kind == Clusters::global) return connected(graph, removed);
  std::vector<std::vector<Index>> result;
  const graph::PoseIndex poses = graph::pose_index(graph);
  Index last = -2;  // pose index of the last one that goes
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (!removed[v]) continue;
    const Index index = poses.index[v];
    const bool runs_on = kind == Clusters::batch && index >= 0 && index == last + 1;
    if (runs_on) {
      result.back().push_back(v);
    } else {
      result.push_back({v});
    }
    if (index >= 0) last = index;
  }
  return result;
}

}  // namespace sg::marginalize
