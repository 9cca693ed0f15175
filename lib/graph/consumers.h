// What other programs cannot take of a graph that is sound in itself.
//
//   g2o    reads in one pass: a line that names a vertex or a parameter has to stand behind it, or is
//          dropped. Ids are of 32 bits. Tags that it does not know, those of edges-only files for want
//          of vertices, are dropped without a word.
//   gtsam  (readG2o) reads poses, points and the edges between poses, in any order, and keys of 64 bits;
//          it knows no FIX line and no other edge.
//   toro   reads poses and one edge a pair of them, from one connected graph, ids of 32 bits; no FIX.
//
// Sources: g2o's OptimizableGraph::load, GTSAM's slam/dataset.cpp, TORO's posegraph2.cpp.
#pragma once

#include <optional>
#include <string_view>

#include "lib/graph/check.h"

namespace sg::graph {

enum class Consumer : std::uint8_t { any, g2o, gtsam, toro };
std::optional<Consumer> consumer(std::string_view name);  // "g2o", "gtsam", "toro"

// What the consumer drops or refuses: errors. Of `any` what g2o, whose format this is, drops in
// silence: warnings. One finding of a kind, at the first line, that counts the others.
Findings check_for(const Graph& graph, Consumer consumer);

}  // namespace sg::graph
