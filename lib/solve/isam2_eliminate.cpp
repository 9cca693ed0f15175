#include <algorithm>

#include "lib/solve/assembly.h"
#include "lib/solve/factorize.h"
#include "lib/solve/isam2_steps.h"
#include "lib/solve/pivots.h"

namespace sg::solve {
namespace {

// Writes the lower triangle of an update above its diagonal, too: by squares, so that no line of memory is met again
// after it has left the cache.
void mirror(const Front& front) {
  const int size = front.n - front.f;
  const std::int64_t ld = front.ld_u();
  for (int column = 0; column < size; column += lane) {
    const int end = std::min(column + lane, size);
    for (int row = column; row < size; row += lane) {
      const int last = std::min(row + lane, size);
      for (int j = column; j < end; ++j) {
        for (int i = std::max(row, j + 1); i < last; ++i) front.u[i * ld + j] = front.u[j * ld + i];
      }
    }
  }
}

// Adds row r, but for its variables without a place in the front.
void add_row(Isam2& isam, Index r, int last_row, const Front& front, const Kernels& kernel) {
  const graph::Pattern& pattern = pattern_of(isam);
  std::vector<Run>& runs = isam.work.runs;
  runs.clear();
  append_runs(pattern.rows[r], pattern.dim, isam.work.row_at, last_row, runs);
  kernel.add(front, isam.grams.data() + isam.gram_at[r], rows_covered(runs), runs.data(),
             static_cast<int>(runs.size()));
}

// The child with the largest update, -1 without one.
Index largest_child(const Isam2& isam, const Isam2Clique& clique) {
  Index largest = -1;
  int size = -1;
  for (Index c = clique.first_child; c >= 0; c = isam.tree.cliques[c].next) {
    const Isam2Clique& child = isam.tree.cliques[c];
    if (child.factor || child.s <= size) continue;
    largest = c;
    size = child.s;
  }
  return largest;
}

// The child's front; its runs are put into work.runs.
Front child_front(Isam2& isam, const Isam2Clique& child, int last_row) {
  const Front from = front_of(isam.tree, child);
  isam.work.runs.clear();
  const bool ascend = append_runs(separators_of(isam.tree, child), pattern_of(isam).dim,
                                  isam.work.row_at, last_row, isam.work.runs);
  if (!ascend && from.u) mirror(from);  // an orphan, whose separator has been ordered anew
  return from;
}

void assemble(Isam2& isam, const Isam2Clique& clique, const Front& front, const Kernels& kernel) {
  std::vector<int>& row_at = isam.work.row_at;
  const std::vector<Run>& runs = isam.work.runs;
  const int last_row =
      place_variables(frontals_of(isam.tree, clique), separators_of(isam.tree, clique),
                      pattern_of(isam).dim, row_at);
  const Index first = largest_child(isam, clique);
  if (first < 0) {
    kernel.clear(front);
  } else {
    const Front from = child_front(isam, isam.tree.cliques[first], last_row);
    start_with(kernel, from, runs, front);
  }
  for (Index r : rows_of(isam.tree, clique)) add_row(isam, r, last_row, front, kernel);
  for (Index c = clique.first_child; c >= 0; c = isam.tree.cliques[c].next) {
    if (c == first) continue;
    const Isam2Clique& child = isam.tree.cliques[c];
    const Front from = child_front(isam, child, last_row);
    add_child(kernel, from, runs, front);
    if (from.u) continue;
    for (Index j : frontals_of(isam.tree, child)) row_at[j] = -1;
    for (Index r : rows_of(isam.tree, child)) add_row(isam, r, last_row, front, kernel);
  }
}

}  // namespace

void eliminate_clique(Isam2& isam, Index c, std::vector<Index>& undetermined) {
  const Isam2Clique& clique = isam.tree.cliques[c];
  const Front front = front_of(isam.tree, clique);
  const Kernels& kernel = kernels();
  assemble(isam, clique, front, kernel);
  const auto frontals = frontals_of(isam.tree, clique);
  const std::vector<int>& dim = pattern_of(isam).dim;
  std::vector<double>& floors = isam.work.floors;
  floors.clear();
  for (Index j : frontals) {
    const auto first = isam.floor.begin() + isam.problem->step_at[j];
    floors.insert(floors.end(), first, first + dim[j]);
  }
  isam.work.numbers.resize(factorization_work(kernel, front.f, front.n));
  if (factorize(kernel, front, floors.data(), isam.work.numbers.data(), 1) > 0)
    append_vanished(front, frontals, dim, undetermined);
}

}  // namespace sg::solve
