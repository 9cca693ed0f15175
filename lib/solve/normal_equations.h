// The normal equations of a linearized system as one sparse matrix:  H = A' A  and  g = A' b, scalar by scalar, in
// elimination order. For the solvers that want a matrix; elimination on the Bayes tree does not form it.
#pragma once

#include <span>
#include <vector>

#include "lib/factor/linearize.h"

namespace sg::solve {

struct NormalEquations {
  std::vector<Index> scalar_at;   // by variable: its first scalar in elimination order
  std::vector<Index> step_at;     // by variable: where its part of a step starts (Problem::step_at)
  std::vector<int> dim;           // by variable
  std::vector<int> column_begin;  // upper triangle of H, compressed by column, rows ascending
  std::vector<int> rows;
  std::vector<double> numbers;
  std::vector<double> gradient;    // g, in elimination order
  std::vector<Offset> pair_begin;  // by row r of A, into pair_at
  std::vector<int> pair_at;  // by pair (a, b) of its variables, a eliminated no later than b: where
                             // rows of a start within a column of b; -1 for the other pairs

  int scalars() const { return static_cast<int>(gradient.size()); }
};

// The structure, for an elimination order.
NormalEquations normal_structure(const factor::LinearSystem& system, const graph::Order& order);

// The numbers. damping: what is added to the diagonal of H, by scalar of a step; empty for nothing.
void form_normal_equations(const factor::LinearSystem& system, std::span<const double> damping,
                           NormalEquations& normal);

// The diagonal of A' A and g, by scalar of a step, straight from the blocks.
void diagonal_and_gradient(const factor::LinearSystem& system, std::vector<double>& diagonal,
                           std::vector<double>& gradient);

}  // namespace sg::solve
