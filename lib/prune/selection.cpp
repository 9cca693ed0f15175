#include "lib/prune/selection.h"

#include <algorithm>

#include "lib/graph/components.h"
#include "lib/prune/candidates.h"
#include "lib/prune/decimate.h"

namespace sg::prune {
namespace {

// Closures come back that join parts of the graph, in file order.
void join_parts(const Choice& choice, const std::vector<bool>& observation,
                std::vector<bool>& kept) {
  const graph::Components parts =
      graph::components(choice.graph, removal_of_rest(choice.graph, choice.candidates, kept).edge);
  graph::DisjointSets joined(parts.count);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (kept[i] || observation[i]) continue;
    const auto ends = choice.graph.edge(choice.candidates[i]);
    for (const Index v : ends) {
      if (join(joined, parts.of[ends[0]], parts.of[v])) kept[i] = true;
    }
  }
}

}  // namespace

Selection selection(const Choice& choice, const std::vector<bool>& kept) {
  Removal removal = removal_of_rest(choice.graph, choice.candidates, kept);
  sweep_landmarks(choice.graph, choice.poses, choice.min_obs, removal);
  removal.vertex.flip();
  removal.edge.flip();
  return {std::move(removal.vertex), std::move(removal.edge)};
}

std::vector<bool> sparse_start(const Choice& choice, Index rate) {
  const std::size_t count = choice.candidates.size();
  if (rate == 1) return std::vector<bool>(count, true);
  std::vector<bool> kept(count, false), observation(count);
  if (rate > 0)
    kept =
        decimate(choice.graph, choice.poses, choice.candidates, rate, DecimationOffset::aligned, 0);
  for (std::size_t i = 0; i < count; ++i) {
    observation[i] = graph::edge_role(choice.graph, choice.poses, choice.candidates[i]) ==
                     graph::EdgeRole::observation;
    if (!observation[i]) kept[i] = false;
  }
  join_parts(choice, observation, kept);
  return kept;
}

bool leave_out(const Choice& choice, Index landmark, std::vector<bool>& kept) {
  bool changed = false;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (!kept[i] || std::ranges::count(choice.graph.edge(choice.candidates[i]), landmark) == 0)
      continue;
    kept[i] = false;
    changed = true;
  }
  return changed;
}

}  // namespace sg::prune
