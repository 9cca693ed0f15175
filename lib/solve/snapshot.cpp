#include "lib/solve/snapshot.h"

namespace sg {
namespace {

void take_patterns(const Isam2& isam, Snapshot& snapshot, std::vector<Index>& row) {
  const Pattern& whole = isam.problem->variables.pattern;
  std::vector<Index> number(whole.variables(), -1);
  snapshot.variable.clear();
  Pattern& pattern = snapshot.pattern;
  pattern.dim.clear();
  pattern.rows.clear();
  for (Index j = 0; j < whole.variables(); ++j) {
    if (isam.clique[j] < 0) continue;
    number[j] = static_cast<Index>(snapshot.variable.size());
    snapshot.variable.push_back(j);
    pattern.dim.push_back(whole.dim[j]);
  }
  for (Index r = 0; r < whole.rows.size(); ++r) {
    if (isam.row_clique[r] < 0) continue;
    if (r == isam.problem->graph->edges()) snapshot.anchored = pattern;
    Pattern& target = r == isam.problem->graph->edges() ? snapshot.anchored : pattern;
    for (Index j : whole.rows[r]) target.rows.items.push_back(number[j]);
    target.rows.close();
    row.push_back(r);
  }
  if (isam.problem->held < 0) snapshot.anchored = pattern;
}

}  // namespace

void take_snapshot(const Isam2& isam, bool numbers, Snapshot& snapshot) {
  std::vector<Index> row;  // of the problem, by row of the snapshot
  take_patterns(isam, snapshot, row);
  if (!numbers) return;
  const Problem& problem = *isam.problem;
  LinearSystem& system = snapshot.system;
  system.pattern = &snapshot.anchored;
  system.height.clear();
  system.begin.assign(1, 0);
  for (Index r : row) {
    const bool gauge = r == problem.graph->edges();
    system.height.push_back(gauge ? problem.variables.pattern.dim[problem.held]
                                  : problem.model[r]->dim);
    int width = 1;
    for (Index j : problem.variables.pattern.rows[r]) width += problem.variables.pattern.dim[j];
    system.begin.push_back(system.begin.back() + system.height.back() * width);
  }
  system.numbers.resize(system.begin.back());
  for (std::size_t k = 0; k < row.size(); ++k)
    linearize_row(problem, isam.linearized, {}, row[k], system.block(static_cast<Index>(k)));
}

}  // namespace sg
