#include "lib/solve/assembly.h"
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

void assemble(Isam2& isam, const Isam2Clique& clique, const Front& front, const Kernels& kernel) {
  const graph::Pattern& pattern = pattern_of(isam);
  std::vector<int>& row_at = isam.work.row_at;
  std::vector<Run>& runs = isam.work.runs;
  const int last_row = place_variables(frontals_of(isam.tree, clique),
                                       separators_of(isam.tree, clique), pattern.dim, row_at);
  kernel.clear(front);
  for (Index r : rows_of(isam.tree, clique)) {
    runs.clear();
    append_runs(pattern.rows[r], pattern.dim, row_at, last_row, runs);
    kernel.add(front, isam.grams.data() + isam.gram_at[r], rows_covered(runs), runs.data(),
               static_cast<int>(runs.size()));
  }
  for (Index c = clique.first_child; c >= 0; c = isam.tree.cliques[c].next) {
    const Isam2Clique& child = isam.tree.cliques[c];
    const Front from = front_of(isam.tree, child);
    runs.clear();
    const bool ascend =
        append_runs(separators_of(isam.tree, child), pattern.dim, row_at, last_row, runs);
    if (!ascend) mirror(from);  // an orphan, whose separator has been ordered anew
    kernel.add(front, from.u, from.ld_u(), runs.data(), static_cast<int>(runs.size()));
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
  if (kernel.factorize(front, floors.data()) > 0)
    append_vanished(front, frontals, dim, undetermined);
}

}  // namespace sg::solve
