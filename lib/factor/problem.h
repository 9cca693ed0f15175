// A graph's numbers, parsed once and laid out flat: what every factor measured, and the estimates.
//
// An estimate vector (Values) holds every vertex of the graph, fixed ones included, in the graph's
// vertex order. Variables are graph_pattern's: the vertices that are not fixed, by ascending id.
// Factors are the graph's edges, in file order.
//
// Gauge. Relative measurements leave the whole free to move. Unless something holds it (a pose with a
// FIX line, or measurements that notice every motion of the whole: gauge.h), the first pose is held:
// it stays a variable of the system, so that the structure (and its elimination complexity) is the
// graph's own, but its columns are zero and an extra last row says that its step is zero. Of a camera
// that is its pose; its focal length is not the gauge's. g2o holds a vertex of its choice.
#pragma once

#include <string>
#include <vector>

#include "lib/factor/model.h"
#include "lib/graph/graph.h"
#include "lib/graph/pattern.h"

namespace sg::factor {

using Values = std::vector<double>;

struct Problem {
  const Graph* graph = nullptr;  // outlives the problem

  std::vector<graph::Space> space;  // n: of every vertex
  std::vector<Index> value_at;      // n + 1: where its estimate starts in Values

  std::vector<const Model*> model;  // m: of every edge
  std::vector<Index> constants_at;  // m, into constants
  std::vector<double> constants;
  std::vector<Index> whitening_at;  // m, into whitening; equal ones in a row are stored once
  std::vector<double> whitening;    // U with W = U' U, dim x dim by column
  std::vector<bool> diagonal;       // m: whether the edge's U is

  graph::GraphPattern variables;  // pattern's rows: the edges, then the gauge's if there is one
  Index held = -1;                // the variable that the gauge's row holds, -1 without one
  std::vector<Index> step_at;  // number of variables + 1: where a variable's part of a step starts
};

// Throws an input Error at its line for: an edge or vertex type without a measurement model, an
// edge that joins other vertices than its type does, a parameter that is missing or of the wrong
// kind, numbers that are missing, infinite or not a number, an information matrix that is not
// positive semidefinite, a quaternion of length zero.
Problem make_problem(const Graph& graph);
Problem make_problem(const Graph&&) = delete;  // it points to the graph

// The estimates of the file's VERTEX lines. An input Error where it has none: start_values
// (initialize.h) composes them.
Values file_values(const Problem& problem);

// How many scalars of the held variable's step are held, the first ones.
inline int held_dim(const Problem& problem) {
  return graph::moving_dim(problem.space[problem.variables.variable_vertex[problem.held]]);
}
// Whether the gauge holds variable j and leaves nothing of it to move.
inline bool is_held(const Problem& problem, Index j) {
  return j == problem.held && held_dim(problem) == problem.variables.pattern.dim[j];
}

// What edge e has of it all.
int dim_of(const Problem& problem, Index e);  // of its error
inline const double* constants_of(const Problem& problem, Index e) {
  return problem.constants.data() + problem.constants_at[e];
}
inline Whitening whitening_of(const Problem& problem, Index e) {
  return {problem.whitening.data() + problem.whitening_at[e], problem.diagonal[e]};
}

// The estimates of edge e's vertices.
using Ends = Room<const double*, max_ends>;
inline Ends ends_of(const Problem& problem, const Values& values, Index e) {
  const auto vertices = problem.graph->edge(e);
  Ends x(vertices.size());
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    x[k] = values.data() + problem.value_at[vertices[k]];
  }
  return x;
}

// Where each variable's part of a step starts, and the end.
std::vector<Index> starts(std::span<const int> dim);

// values (+) step, variable by variable.
void retract(const Problem& problem, const std::vector<double>& step, Values& values);

// The estimate's numbers as a VERTEX line writes them; as text, separated by blanks, the shortest
// that read back as the same doubles; and the whole line with its newline.
std::vector<double> estimate_numbers(const Problem& problem, const Values& values, Index v);
std::string estimate_text(const Problem& problem, const Values& values, Index v);
std::string vertex_line(const Problem& problem, const Values& values, Index v);

}  // namespace sg::factor
