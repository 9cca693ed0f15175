#include <algorithm>
#include <cmath>

#include "lib/solve/isam2_leave.h"
#include "lib/solve/isam2_steps.h"

namespace sg::solve {
namespace {

bool separator_changed(const Isam2& isam, const Isam2Clique& clique) {
  return std::ranges::any_of(separators_of(isam.tree, clique),
                             [&](Index j) { return isam.changed[j] == isam.updates; });
}

// Solves for the frontal variables into work.numbers; returns how far, at most, they are from what
// was last passed down.
double solve(Isam2& isam, const Isam2Clique& clique, const Kernels& kernel) {
  const Front front = front_of(isam.tree, clique);
  std::vector<double>& x = isam.work.numbers;
  x.assign(front.ld_l(), 0.0);
  const std::vector<Index>& at = isam.problem->step_at;
  int row = front.f;
  for (Index j : separators_of(isam.tree, clique)) {
    for (Index k = at[j]; k < at[j + 1]; ++k) x[row++] = isam.step[k];
  }
  x[row] = -1;
  kernel.back_substitute(front, x.data());
  double change = 0;
  row = 0;
  for (Index j : frontals_of(isam.tree, clique)) {
    for (Index k = at[j]; k < at[j + 1]; ++k)
      change = std::max(change, std::abs(x[row++] - isam.told[k]));
  }
  return change;
}

// Passes the step of variable j down if it is far enough from what was passed before.
void tell(Isam2& isam, Index j) {
  const auto begin = isam.problem->step_at[j], end = isam.problem->step_at[j + 1];
  double change = 0;
  for (Index k = begin; k < end; ++k)
    change = std::max(change, std::abs(isam.step[k] - isam.told[k]));
  if (change < isam.options.wildfire_threshold) return;
  std::copy(isam.step.begin() + begin, isam.step.begin() + end, isam.told.begin() + begin);
  isam.changed[j] = isam.updates;
}

// The estimate of variable j from its step. False if it is not finite.
bool update_estimate(Isam2& isam, Index j) {
  const factor::Problem& problem = *isam.problem;
  const Index v = problem.variables.variable_vertex[j];
  const Index begin = problem.value_at[v], end = problem.value_at[v + 1];
  std::copy(isam.linearized.begin() + begin, isam.linearized.begin() + end,
            isam.estimate.begin() + begin);
  factor::retract(problem.space[v], isam.step.data() + problem.step_at[j],
                  isam.estimate.data() + begin);
  return std::all_of(isam.estimate.begin() + begin, isam.estimate.begin() + end,
                     [](double number) { return std::isfinite(number); });
}

// The frontal variables' steps out of work.numbers, and their estimates. False if one is not finite.
bool take_over(Isam2& isam, const Isam2Clique& clique) {
  const double* x = isam.work.numbers.data();
  bool finite = true;
  for (Index j : frontals_of(isam.tree, clique)) {
    const int dim = pattern_of(isam).dim[j];
    std::copy_n(x, dim, isam.step.begin() + isam.problem->step_at[j]);
    x += dim;
    finite &= update_estimate(isam, j);
  }
  return finite;
}

bool accept(Isam2& isam, const Isam2Clique& clique) {
  const bool finite = take_over(isam, clique);
  for (Index j : frontals_of(isam.tree, clique)) {
    tell(isam, j);
    if (largest(isam, j) >= isam.options.relinearize_threshold) propose(isam, j);
  }
  return finite;
}

}  // namespace

bool solve_down(Isam2& isam) {
  const Kernels& kernel = kernels();
  bool finite = true;
  std::vector<Index>& stack = isam.work.stack;
  stack.clear();
  for (Index c : isam.work.made) {
    if (isam.tree.cliques[c].parent < 0) stack.push_back(c);
  }
  while (!stack.empty()) {
    const Isam2Clique& clique = isam.tree.cliques[stack.back()];
    stack.pop_back();
    if (is_prior(clique)) continue;
    const bool made = clique.made == isam.updates;
    if (!made && !separator_changed(isam, clique)) continue;
    const double change = solve(isam, clique, kernel);
    if (made || change >= isam.options.wildfire_threshold) finite &= accept(isam, clique);
    for (Index child = clique.first_child; child >= 0; child = isam.tree.cliques[child].next)
      stack.push_back(child);
  }
  return finite;
}

void smooth_past(Isam2& isam) {
  const Kernels& kernel = kernels();
  for (auto c = isam.past.rbegin(); c != isam.past.rend(); ++c) {
    solve(isam, isam.tree.cliques[*c], kernel);
    take_over(isam, isam.tree.cliques[*c]);
  }
}

}  // namespace sg::solve
