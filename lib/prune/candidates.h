// What may be pruned, and what leaves with it.
//
// Candidates are observations or loop closures (lib/graph/replay.h). Odometry, unary edges and
// edges with a vertex that is neither pose nor landmark never are: what odometry connects stays
// connected.
#pragma once

#include <string_view>
#include <vector>

#include "lib/graph/graph.h"
#include "lib/graph/replay.h"

namespace sg::prune {

enum class Candidates : std::uint8_t { observations, loops, both };

// Observations where the graph has landmarks, loop closures where it has none.
Candidates natural_candidates(const Graph& graph);
// "observations", "loops" or "both"; the natural ones where the name is empty. Throws a usage Error for another.
Candidates candidates_named(std::string_view name, const Graph& graph);
// Edges, in file order.
std::vector<Index> candidate_edges(const Graph& graph, const graph::PoseIndex& poses,
                                   Candidates kind);

// How many stay of so many candidates where one in `rate` does: to the nearest.
inline std::size_t one_in(Index rate, std::size_t candidates) {
  return (candidates + rate / 2) / rate;
}

// What a policy removes from a graph.
struct Removal {
  std::vector<bool> vertex;  // n
  std::vector<bool> edge;    // m
};
Removal nothing_removed(const Graph& graph);
// All candidates but those kept (candidates and kept side by side).
Removal removal_of_rest(const Graph& graph, const std::vector<Index>& candidates,
                        const std::vector<bool>& kept);

// Removes the landmarks that are left with fewer than min_obs observations, with their edges, until
// every landmark has enough. A landmark without any observation in the input (one that only a prior
// knows, say) is not pruning's business and stays. O(edges).
void sweep_landmarks(const Graph& graph, const graph::PoseIndex& poses, Index min_obs,
                     Removal& removal);

}  // namespace sg::prune
