// What some edges say of their vertices, linearized: the quadratic
//     s' W s - 2 g' s + constant
// in the steps s (lib/factor/space.h) of the vertices from the estimates, W = J' J, g = -J' e with whitened Jacobian
// and error. It does not matter which vertices are constants: all of an edge's have columns.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "lib/factor/problem.h"

namespace sg::marginalize {

// Where things are linearized.
struct At {
  const factor::Problem& problem;
  const factor::Values& values;

  const double* x(Index v) const { return values.data() + problem.value_at[v]; }
  graph::Space space(Index v) const { return problem.space[v]; }
  int dim(Index v) const { return graph::space_dim(problem.space[v]); }
};

struct Piece {
  std::vector<Index> vertices;  // ascending
  Eigen::MatrixXd information;  // W
  Eigen::VectorXd gradient;     // g
  bool absolute = false;  // whether it can tell where the whole is (else it only moves with it)
};

// How many scalars these vertices' steps have.
int total_dim(const At& at, std::span<const Index> vertices);
// Where the step of each starts in the step of all, and the end.
std::vector<int> starts(const At& at, std::span<const Index> vertices);
// Of all vertices of the graph.
std::vector<int> starts_of_all(const At& at);

// Whether an edge tells where the whole is.
bool is_absolute(const At& at, Index e);

// Of an edge with a model. Throws a computation Error where it has no derivative at the estimates.
Piece piece_of_edge(const At& at, Index e);

// All of them together.
Piece sum(const At& at, std::span<const Piece* const> pieces);

// What is left when v may take any value: the Schur complement of v. Of what v is not determined in, nothing is known.
Piece eliminated(const At& at, const Piece& piece, Index v);

// The line, with its newline, that says all of a piece: EDGE_LINEAR, or EDGE_LINEAR_RELATIVE where it is not absolute
// and has a pose to be seen from. Empty where there is nothing to say.
std::string linear_line(const At& at, const Piece& piece);

}  // namespace sg::marginalize
