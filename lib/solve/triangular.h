// The factor of an eliminated system as a triangle, A' A = L L', for many right-hand sides, and for
// sparse ones.
//
// Rows of right-hand sides stand in elimination order: those of a clique's frontal variables are
// consecutive. From one row to the next are a multiple of `lane` numbers, at least as many as columns; what is
// between is written over. L x = b with b zero but for some variables is zero but for the cliques on their paths
// to the root (Gilbert and Peierls, Sparse partial pivoting in time proportional to arithmetic
// operations, 1988; on a tree: Liu 1990).
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "lib/solve/eliminate.h"

namespace sg::solve {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using RowsRef = Eigen::Ref<Rows, 0, Eigen::OuterStride<>>;

struct Triangle {
  Elimination* elimination = nullptr;  // outlives it, after eliminate()
  std::vector<Index> clique;           // n: of every variable
  std::vector<Index> first_row;        // C + 1
  graph::Lists<> separator_rows;       // C
  int most_separator_rows = 0;         // of a clique

  Index row(Index variable) const { return elimination->floor_at[variable]; }
  Index rows() const { return first_row.back(); }
};
Triangle triangle(Elimination& elimination);

// The cliques on these variables' paths to the roots, ascending: children before parents.
std::vector<Index> path(const Triangle& triangle, std::span<const Index> variables);

// x := L^-1 x in these cliques, ascending; all other rows that matter are zero.
void solve_lower(const Triangle& triangle, std::span<const Index> cliques, RowsRef x);
// The same of all cliques; x := L'^-1 x.
void solve_lower(const Triangle& triangle, RowsRef x);
void solve_upper(const Triangle& triangle, RowsRef x);

}  // namespace sg::solve
