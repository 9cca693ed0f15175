#include "lib/solve/normal_equations.h"

#include <algorithm>
#include <cassert>

namespace sg::solve {
namespace {

double dot(const double* a, const double* b, int n) {
  double sum = 0;
  for (int k = 0; k < n; ++k) sum += a[k] * b[k];
  return sum;
}

// Entries of variable j's scalar columns: those of its neighbours eliminated before it, then its own upper triangle.
void append_columns(const std::vector<Index>& earlier, Index j, NormalEquations& normal) {
  for (int b = 0; b < normal.dim[j]; ++b) {
    for (Index i : earlier) {
      for (int a = 0; a < normal.dim[i]; ++a) normal.rows.push_back(normal.scalar_at[i] + a);
    }
    for (int a = 0; a <= b; ++a) normal.rows.push_back(normal.scalar_at[j] + a);
    normal.column_begin.push_back(graph::item_count(normal.rows.size()));
  }
}

// Where the pairs that end in variable j have their place within its columns. `place` is by variable.
void set_pairs(const graph::Pattern& pattern, std::span<const Index> rows_of_j, Index j,
               const std::vector<int>& place, NormalEquations& normal) {
  for (Index r : rows_of_j) {
    const auto variables = pattern.rows[r];
    const auto count = static_cast<Offset>(variables.size());
    const auto b = std::find(variables.begin(), variables.end(), j) - variables.begin();
    for (Offset a = 0; a < count; ++a) {
      if (normal.scalar_at[variables[a]] > normal.scalar_at[j]) continue;
      normal.pair_at[normal.pair_begin[r] + a * count + b] = place[variables[a]];
    }
  }
}

// The block of pair (a, b) += A_a' A_b; of the diagonal pair the upper triangle.
void add_pair(const double* a, int dim_a, const double* b, int dim_b, int height, bool diagonal,
              const int* column_begin, int place, double* numbers) {
  for (int k = 0; k < dim_b; ++k) {
    double* const to = numbers + column_begin[k] + place;
    const int last = diagonal ? k + 1 : dim_a;
    for (int i = 0; i < last; ++i) to[i] += dot(a + i * height, b + k * height, height);
  }
}

void add_row(const factor::LinearSystem& system, Index r, NormalEquations& normal) {
  const auto variables = system.pattern->rows[r];
  const auto count = static_cast<Offset>(variables.size());
  const int height = system.height[r];
  const int* const places = normal.pair_at.data() + normal.pair_begin[r];
  const double* const block = system.block(r);
  const double* const right = system.numbers.data() + system.begin[r + 1] - height;
  const double* column_b = block;
  for (Offset b = 0; b < count; ++b) {
    const Index j = variables[b];
    const double* column_a = block;
    for (Offset a = 0; a < count; ++a) {
      const int place = places[a * count + b], dim_a = normal.dim[variables[a]];
      if (place >= 0) {
        add_pair(column_a, dim_a, column_b, normal.dim[j], height, a == b,
                 normal.column_begin.data() + normal.scalar_at[j], place, normal.numbers.data());
      }
      column_a += height * dim_a;
    }
    for (int k = 0; k < normal.dim[j]; ++k) {
      normal.gradient[normal.scalar_at[j] + k] += dot(column_b + k * height, right, height);
    }
    column_b += height * normal.dim[j];
  }
}

}  // namespace

NormalEquations normal_structure(const factor::LinearSystem& system, const graph::Order& order) {
  const graph::Pattern& pattern = *system.pattern;
  assert(graph::is_permutation(order, pattern.variables()) && factor::is_laid_out(system));
  NormalEquations normal;
  normal.dim = pattern.dim;
  normal.step_at = factor::starts(pattern.dim);
  normal.scalar_at.resize(pattern.variables());
  Index scalars = 0;
  for (Index j : order) {
    normal.scalar_at[j] = scalars;
    scalars += pattern.dim[j];
  }
  normal.pair_begin.push_back(0);
  for (Index r = 0; r < pattern.rows.size(); ++r) {
    const auto count = static_cast<Offset>(pattern.rows[r].size());
    normal.pair_begin.push_back(normal.pair_begin.back() + count * count);
  }
  normal.pair_at.assign(normal.pair_begin.back(), -1);

  const graph::Adjacency neighbours = graph::adjacency(pattern);
  const graph::Lists<> rows_of = graph::columns(pattern);
  std::vector<int> place(pattern.variables(), -1);
  normal.column_begin.push_back(0);
  for (Index j : order) {
    std::vector<Index> earlier;
    std::ranges::copy_if(neighbours[j], std::back_inserter(earlier),
                         [&](Index i) { return normal.scalar_at[i] < normal.scalar_at[j]; });
    std::ranges::sort(earlier, {}, [&](Index i) { return normal.scalar_at[i]; });
    int height = 0;
    for (Index i : earlier) {
      place[i] = height;
      height += pattern.dim[i];
    }
    place[j] = height;
    set_pairs(pattern, rows_of[j], j, place, normal);
    append_columns(earlier, j, normal);
  }
  normal.numbers.resize(normal.rows.size());
  normal.gradient.resize(scalars);
  return normal;
}

void form_normal_equations(const factor::LinearSystem& system, std::span<const double> damping,
                           NormalEquations& normal) {
  assert(factor::is_laid_out(system) && system.pattern->dim == normal.dim);
  assert(damping.empty() || damping.size() == normal.gradient.size());
  std::ranges::fill(normal.numbers, 0.0);
  std::ranges::fill(normal.gradient, 0.0);
  for (Index r = 0; r < system.pattern->rows.size(); ++r) add_row(system, r, normal);
  if (damping.empty()) return;
  for (std::size_t j = 0; j < normal.dim.size(); ++j) {
    for (int k = 0; k < normal.dim[j]; ++k) {
      const int diagonal = normal.column_begin[normal.scalar_at[j] + k + 1] - 1;
      normal.numbers[diagonal] += damping[normal.step_at[j] + k];
    }
  }
}

void diagonal_and_gradient(const factor::LinearSystem& system, std::vector<double>& diagonal,
                           std::vector<double>& gradient) {
  const graph::Pattern& pattern = *system.pattern;
  const auto step_at = factor::starts(pattern.dim);
  diagonal.assign(step_at.back(), 0.0);
  gradient.assign(step_at.back(), 0.0);
  for (Index r = 0; r < pattern.rows.size(); ++r) {
    const int height = system.height[r];
    const double* column = system.block(r);
    const double* const right = system.numbers.data() + system.begin[r + 1] - height;
    for (Index j : pattern.rows[r]) {
      for (Index k = step_at[j]; k < step_at[j + 1]; ++k, column += height) {
        diagonal[k] += dot(column, column, height);
        gradient[k] += dot(column, right, height);
      }
    }
  }
}

}  // namespace sg::solve
