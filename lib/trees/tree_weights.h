// A graph as spanning trees see it: nodes, and weighted links between them.
//
// The determinant of the information matrix of a linear SLAM problem is the weighted number of
// spanning trees of its graph (the matrix-tree theorem), and of pose graphs in the plane
//     log det = 2 log t(w_translation) + log t(w_rotation) + small terms
// where w are the information of an edge's translation and of its rotation (Khosoussi, Huang,
// Dissanayake: Novel insights into the impact of graph structure on SLAM, 2014; Khosoussi,
// Sukhatme, Huang, Dissanayake: Designing sparse reliable pose-graph SLAM, 2016). In space both
// count three times.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "lib/graph/graph.h"
#include "lib/graph/lists.h"

namespace sg::trees {

enum class TreeWeights : std::uint8_t { unit, translation, rotation, dopt };
// The kind of that name, if there is one.
std::optional<TreeWeights> tree_weights(std::string_view name);

// Vertices are nodes; all fixed vertices together are one node, as constants they are all known.
struct TreeNodes {
  Index count = 0;
  std::vector<Index> node;  // n: of every vertex
};
TreeNodes tree_nodes(const Graph& graph);

// The links between nodes that every edge makes: from its first vertex to each of the others.
struct TreeEdge {
  Index u, v;
};
graph::Lists<TreeEdge> tree_links(const Graph& graph, const TreeNodes& nodes);

// What one kind of weight makes of the edges. An edge of weight 0 has no part in it. D-optimality
// has two layers, all others one.
struct TreeLayer {
  double multiplicity = 1;     // of log t in the criterion
  std::vector<double> weight;  // m
};

// Weights by edge. Unit weights are 1 for every edge of two or more vertices. The others come from
// its information matrix W (rotation in radians): the geometric mean of the eigenvalues of W's
// translation or rotation block, that is the d-th root of the block's determinant. A point's
// observation weighs nothing in rotation. Throws an input Error for an edge that measures neither
// (a camera's pixels, say), under any but unit weights.
std::vector<TreeLayer> tree_layers(const Graph& graph, TreeWeights kind);

}  // namespace sg::trees
