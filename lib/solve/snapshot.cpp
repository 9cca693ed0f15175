#include "lib/solve/snapshot.h"

namespace sg::solve {
namespace {

void take_patterns(const Isam2& isam, Snapshot& snapshot) {
  const graph::Pattern& whole = isam.problem->variables.pattern;
  std::vector<Index> number(whole.variables(), -1);
  snapshot.variable.clear();
  snapshot.row.clear();
  graph::Pattern& pattern = snapshot.pattern;
  pattern.dim.clear();
  pattern.rows.clear();
  for (Index j = 0; j < whole.variables(); ++j) {
    if (isam.tree.variable_clique[j] < 0) continue;
    number[j] = static_cast<Index>(snapshot.variable.size());
    snapshot.variable.push_back(j);
    pattern.dim.push_back(whole.dim[j]);
  }
  for (Index r = 0; r < whole.rows.size(); ++r) {
    if (isam.tree.row_clique[r] < 0) continue;
    if (r == isam.problem->graph->edges()) snapshot.anchored = pattern;
    graph::Pattern& target = r == isam.problem->graph->edges() ? snapshot.anchored : pattern;
    for (Index j : whole.rows[r]) target.rows.items.push_back(number[j]);
    target.rows.close();
    snapshot.row.push_back(r);
  }
  if (isam.problem->held < 0) snapshot.anchored = pattern;
  for (const Isam2Clique& c : isam.tree.cliques) {
    if (!is_there(c) || !is_prior(c)) continue;
    for (Index j : separators_of(isam.tree, c)) pattern.rows.items.push_back(number[j]);
    pattern.rows.close();
  }
}

}  // namespace

void take_snapshot(const Isam2& isam, bool numbers, Snapshot& snapshot) {
  take_patterns(isam, snapshot);
  if (!numbers) return;
  const factor::Problem& problem = *isam.problem;
  factor::LinearSystem& system = snapshot.system;
  system.pattern = &snapshot.anchored;
  system.height.clear();
  system.begin.assign(1, 0);
  for (Index r : snapshot.row) {
    system.height.push_back(factor::block_rows(problem, r));
    system.begin.push_back(system.begin.back() +
                           system.height.back() *
                               factor::block_columns(problem.variables.pattern, r));
  }
  system.numbers.resize(system.begin.back());
  linearize_at(problem, isam.linearized, snapshot);
}

void linearize_at(const factor::Problem& problem, const factor::Values& values,
                  Snapshot& snapshot) {
  for (Index k = 0; k < static_cast<Index>(snapshot.row.size()); ++k)
    factor::linearize_row(problem, values, {}, snapshot.row[k], snapshot.system.block(k));
}

}  // namespace sg::solve
