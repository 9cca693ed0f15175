// The block pattern of the linearized system's Jacobian A: a row for every factor, a column for
// every variable. It is all that ordering and elimination ever see of a graph.
#pragma once

#include <span>
#include <vector>

#include "lib/graph/graph.h"

namespace sg {

struct Pattern {
  std::vector<int> dim;              // n: tangent dimension of every variable
  std::vector<Index> row_begin;      // m + 1, into row_variables
  std::vector<Index> row_variables;  // distinct variables of every factor, in file order

  Index variables() const { return static_cast<Index>(dim.size()); }
  Index rows() const { return static_cast<Index>(row_begin.size()) - 1; }
  std::span<const Index> row(Index r) const {
    return {row_variables.data() + row_begin[r],
            static_cast<std::size_t>(row_begin[r + 1] - row_begin[r])};
  }
};

// An elimination order: order[k] is the variable that goes k-th. A permutation of 0..n-1.
using Order = std::vector<Index>;

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

// The columns of a pattern: for every variable, the rows it stands in, ascending (the transpose).
struct Columns {
  std::vector<Index> begin;  // n + 1
  std::vector<Index> rows;
  std::span<const Index> operator[](Index j) const {
    return {rows.data() + begin[j], static_cast<std::size_t>(begin[j + 1] - begin[j])};
  }
};
Columns columns(const Pattern& pattern);

// The graph of A^T A: for every variable its neighbours, ascending, without itself and without
// duplicates. For orderings that want adjacency; elimination does not form it.
struct Adjacency {
  std::vector<Index> begin;  // n + 1
  std::vector<Index> neighbours;
  Index size() const { return static_cast<Index>(begin.size()) - 1; }
  std::span<const Index> operator[](Index j) const {
    return {neighbours.data() + begin[j], static_cast<std::size_t>(begin[j + 1] - begin[j])};
  }
};
Adjacency adjacency(const Pattern& pattern);

}  // namespace sg
