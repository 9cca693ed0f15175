#include "lib/solve/isam2.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "lib/solve/isam2_steps.h"

namespace sg::solve {

Isam2 make_isam2(const factor::Problem& problem, const Isam2Options& options) {
  order::find_ordering(options.ordering);
  Isam2 isam;
  isam.problem = &problem;
  isam.options = options;
  const graph::Pattern& pattern = problem.variables.pattern;
  const Index n = pattern.variables();
  isam.tree.variable_clique.assign(n, -1);
  isam.tree.row_clique.assign(pattern.rows.size(), -1);
  isam.columns = graph::columns(pattern);
  isam.linearized.assign(problem.value_at.back(), 0.0);
  isam.estimate = isam.linearized;
  isam.step.assign(problem.step_at.back(), 0.0);
  isam.told = isam.step;
  isam.changed.assign(n, -1);
  isam.floor.assign(problem.step_at.back(), 0.0);
  isam.moved.assign(n, false);
  isam.unseen.assign(n, false);
  isam.leaving.assign(n, false);
  isam.pinned.assign(n, false);
  isam.row_update.assign(pattern.rows.size(), -1);
  isam.forgotten.assign(pattern.rows.size(), false);
  isam.gram_at.assign(pattern.rows.size(), -1);
  isam.work.local.assign(n, -1);
  isam.work.row_at.assign(n, -1);
  return isam;
}

Index begin_update(Isam2& isam, std::span<const Index> rows) {
  ++isam.updates;
  isam.work.marked.clear();
  const Index moved = relinearize(isam);
  for (Index r : rows) {
    hold_row(isam, r);
    linearize_factor(isam, r);
    for (Index j : pattern_of(isam).rows[r]) mark_to_root(isam, isam.tree.variable_clique[j]);
  }
  return moved;
}

Isam2Report update(Isam2& isam, std::span<const Index> variables, std::span<const Index> rows) {
  assert(std::ranges::all_of(variables, [&](Index j) { return isam.tree.variable_clique[j] < 0; }));
  assert(std::ranges::all_of(rows, [&](Index r) {
    return isam.tree.row_clique[r] < 0 && !pattern_of(isam).rows[r].empty();
  }));
  Isam2Report report;
  report.relinearized = begin_update(isam, rows);
  redo_and_solve(isam, variables, rows, plan_top(isam, variables, rows), report);
  return report;
}

namespace {

Offset gram_size(const Isam2& isam, Index r) {
  const Offset width = factor::block_columns(pattern_of(isam), r);
  return width * width;
}

}  // namespace

void hold_row(Isam2& isam, Index r) {
  if (isam.gram_at[r] >= 0) return;
  isam.gram_at[r] = isam.gram_pool.take(gram_size(isam, r));
  if (isam.gram_pool.end() > static_cast<Offset>(isam.grams.size()))
    isam.grams.resize(isam.gram_pool.end() + isam.gram_pool.end() / 2);
}

void let_row_go(Isam2& isam, Index r) {
  if (isam.tree.row_clique[r] >= 0) --isam.rows;
  isam.tree.row_clique[r] = -1;
  if (isam.gram_at[r] < 0) return;
  isam.gram_pool.give(isam.gram_at[r], gram_size(isam, r));
  isam.gram_at[r] = -1;
}

std::vector<Index> rows_in(const Isam2& isam, Index j) {
  std::vector<Index> rows;
  std::ranges::copy_if(rows_of(isam, j), std::back_inserter(rows),
                       [&](Index r) { return isam.tree.row_clique[r] >= 0; });
  return rows;
}

double chi2(const Isam2& isam) {
  double sum = 0;
  for (Index e = 0; e < isam.problem->graph->edges(); ++e) {
    if (isam.tree.row_clique[e] >= 0)
      sum += factor::finite_edge_chi2(*isam.problem, isam.estimate, e);
  }
  return sum;
}

double largest(const Isam2& isam, Index j) {
  double most = 0;
  for (Index k = isam.problem->step_at[j]; k < isam.problem->step_at[j + 1]; ++k)
    most = std::max(most, std::abs(isam.step[k]));
  return most;
}

void propose(Isam2& isam, Index j) {
  if (isam.moved[j]) return;
  isam.moved[j] = true;
  isam.candidates.push_back(j);
}

}  // namespace sg::solve
