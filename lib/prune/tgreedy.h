// Keep the candidates that carry the most: greedy maximization of the weighted number of spanning
// trees (Khosoussi, Sukhatme, Huang, Dissanayake: Designing sparse reliable pose-graph SLAM, 2016,
// algorithm 1; the policy "tgreedy" of Frey, Steiner, How).
//
// Start from the graph without its candidates. While fewer than k are kept, add the one of largest
// gain
//     sum over layers of  multiplicity * log(1 + w R)
// with R its effective resistance in the graph as it is then. A candidate that joins two parts of
// the graph (the first observation of a landmark; a loop closure between trajectories) comes before
// all that do not, whatever their gains: without it the graph has no spanning tree at all. Among
// those, its gain is log w, by which it multiplies the product of the parts' trees. Equal gains (to
// 30 bits) go by file order.
//
// Gains only ever shrink as a graph grows (log t is submodular), so that a gain computed earlier
// bounds the gain now: candidates wait in a heap under their last gain, and only the top is
// computed anew (Minoux 1978). The result is the textbook algorithm's.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "lib/graph/graph.h"
#include "lib/graph/replay.h"
#include "lib/trees/tree_weights.h"

namespace sg::prune {

struct Accepted {
  Index edge;
  bool joins;        // two parts
  double gain;       // of the criterion
  double criterion;  // after it: sum over layers of multiplicity * log t
};

// Told how many are accepted, and asked whether to go on: what is accepted by then is the textbook algorithm's, too.
using GoOn = std::function<bool(std::size_t accepted)>;

// The candidates to keep, in the order in which they are accepted: `count` of them, or all. Throws
// an input Error for a candidate of other than two vertices.
std::vector<Accepted> tgreedy(const Graph& graph, const std::vector<Index>& candidates,
                              std::size_t count, trees::Weights weights, const GoOn& go_on = {});

// Of every candidate, whether it is among the accepted.
std::vector<bool> kept_by(const std::vector<Index>& candidates, std::span<const Accepted> accepted);

// The choice that a robot could have made: after every `batch` steps of the replay it spends that
// batch's share of `count` on the candidates seen so far, in the graph seen so far. After c of the
// n candidates, round(count c / n) are spent.
std::vector<Accepted> tgreedy_online(const Graph& graph, const graph::PoseIndex& poses,
                                     const std::vector<Index>& candidates, std::size_t count,
                                     trees::Weights weights, Index batch, const GoOn& go_on = {});

// Parts of the graph's poses that the kept candidates and the other edges do not join.
Index pose_parts(const Graph& graph, const graph::PoseIndex& poses,
                 const std::vector<bool>& edge_removed);

}  // namespace sg::prune
