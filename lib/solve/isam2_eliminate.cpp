#include "lib/solve/assembly.h"
#include "lib/solve/factorize.h"
#include "lib/solve/isam2_steps.h"
#include "lib/solve/pivots.h"

namespace sg::solve {
namespace {

// Writes the lower triangle of an update above its diagonal, too.
void mirror(const Front& front) {
  const std::int64_t ld = front.ld_u();
  for (int j = 0; j < front.n - front.f; ++j) {
    for (int i = j + 1; i < front.n - front.f; ++i) front.u[i * ld + j] = front.u[j * ld + i];
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

void assemble(Isam2& isam, const Isam2Clique& clique, const Front& front, const Kernels& kernel) {
  const graph::Pattern& pattern = pattern_of(isam);
  std::vector<int>& row_at = isam.work.row_at;
  std::vector<Run>& runs = isam.work.runs;
  const int last_row = place_variables(frontals_of(isam.tree, clique),
                                       separators_of(isam.tree, clique), pattern.dim, row_at);
  kernel.clear(front);
  for (Index r : rows_of(isam.tree, clique)) add_row(isam, r, last_row, front, kernel);
  for (Index c = clique.first_child; c >= 0; c = isam.tree.cliques[c].next) {
    const Isam2Clique& child = isam.tree.cliques[c];
    const Front from = front_of(isam.tree, child);
    runs.clear();
    const bool ascend =
        append_runs(separators_of(isam.tree, child), pattern.dim, row_at, last_row, runs);
    if (!ascend && from.u) mirror(from);  // an orphan, whose separator has been ordered anew
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
