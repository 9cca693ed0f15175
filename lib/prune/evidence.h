// What the edges of a graph tell of its variables, in numbers: rows with their Jacobians.
//
// Rows are the graph's edges, then those that hold its gauge, which are never left out. Measured: the
// linearized problem. As trees: every variable has one scalar, and an edge between u and v is the row
// sqrt(w) (x_u - x_v), so that the information matrix is the graph's Laplacian without the ground, and its determinant
// the number of spanning trees (lib/trees/tree_weights.h). That knows any tag.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/factor/linearize.h"

namespace sg::prune {

struct Evidence {
  graph::Pattern pattern;     // variables and rows
  std::vector<int> height;    // of every row's block [A b], by column
  std::vector<Offset> begin;  // of every block in numbers, and the end
  std::vector<double> numbers;
  std::vector<Index> step_at;  // n + 1: where a variable's scalars start
  std::vector<bool> position;  // of every scalar: whether it is one of a pose's position
  Eigen::MatrixXd drift;  // scalars x motions: of the positions when the whole moves, orthonormal
  Index poses = 0;        // of the graph, constants included
  bool held = true;       // whether a row of its own holds the gauge
  std::vector<Index> variable_vertex;  // as in GraphPattern
  std::vector<Index> vertex_variable;

  const double* block(Index r) const { return numbers.data() + begin[r]; }
};

// Linearized at `values`. Throws as factor::linearize.
Evidence measured_evidence(const factor::Problem& problem, const factor::Values& values);
// Unit weights; every component without a constant has a variable on the ground. No scalar is a position.
Evidence tree_evidence(const Graph& graph);

}  // namespace sg::prune
