// The block pattern of the linearized system's Jacobian A: a row for every factor, a column for
// every variable. It is all that ordering and elimination ever see of a graph.
#pragma once

#include <span>
#include <vector>

#include "lib/graph/graph.h"
#include "lib/graph/lists.h"

namespace sg::graph {

struct Pattern {
  std::vector<int> dim;  // n: tangent dimension of every variable
  Lists<> rows;          // m: distinct variables of every factor, in file order
  // The fixed vertices of every row, numbered from 0; no lists where nothing is fixed. They have no
  // part in the elimination, but break ties in orderings of the factors themselves (COLAMD).
  Lists<> constants = {};

  Index variables() const { return static_cast<Index>(dim.size()); }
};

// An elimination order: order[k] is the variable that goes k-th. A permutation of 0..n-1.
using Order = std::vector<Index>;
bool is_permutation(std::span<const Index> order, Index n);

// Variables are the graph's vertices that are not fixed, by ascending id; rows are its edges in
// file order. variable_vertex[j] is the vertex of variable j; vertex_variable[v] the variable of
// vertex v, -1 if fixed.
struct GraphPattern {
  Pattern pattern;
  std::vector<Index> variable_vertex;
  std::vector<Index> vertex_variable;
};
GraphPattern graph_pattern(const Graph& graph);
// The same of a part of the graph: the vertices and edges that are marked, where an edge that is in
// has all its vertices in. vertex_variable is -1 of vertices outside.
GraphPattern graph_pattern(const Graph& graph, const std::vector<bool>& vertex_in,
                           const std::vector<bool>& edge_in);

// The columns of a pattern: for every variable, the rows it stands in, ascending.
inline Lists<> columns(const Pattern& pattern) {
  return transpose(pattern.rows, pattern.variables());
}

// The graph of A^T A: for every variable its neighbours, ascending, without itself and without
// duplicates. For orderings that want adjacency; elimination does not form it. Throws a computation
// Error if there are too many for an Index (an edge of 46,342 vertices makes as many).
using Adjacency = Lists<>;
Adjacency adjacency(const Pattern& pattern);

}  // namespace sg::graph
