#include <algorithm>

#include "lib/solve/assembly.h"
#include "lib/solve/clique_tree.h"
#include "lib/solve/isam2_leave.h"
#include "lib/solve/isam2_steps.h"

namespace sg::solve {
namespace {

// Beyond this share of all variables, the others come along: a new ordering pays.
constexpr double reorder_all = 0.65;

void mark_all_if_many(Isam2& isam) {
  Index redone = 0;
  for (Index c : isam.work.marked) redone += isam.tree.cliques[c].frontals;
  if (redone <= reorder_all * isam.variables) return;
  mark_all(isam);
}

// The variables and rows of the top: the new ones and what the marked cliques hold. The orphans: what hangs below them.
void gather_top(Isam2& isam, std::span<const Index> new_variables,
                std::span<const Index> new_rows) {
  Isam2::Work& work = isam.work;
  work.variables.assign(new_variables.begin(), new_variables.end());
  work.rows.assign(new_rows.begin(), new_rows.end());
  work.orphans.clear();
  for (Index c : work.marked) {
    const Isam2Clique& clique = isam.tree.cliques[c];
    const auto frontals = frontals_of(isam.tree, clique);
    const auto rows = rows_of(isam.tree, clique);
    // Some may have been given back (isam2_admission.h).
    std::ranges::copy_if(frontals, std::back_inserter(work.variables),
                         [&](Index j) { return isam.tree.variable_clique[j] >= 0; });
    std::ranges::copy_if(rows, std::back_inserter(work.rows), [&](Index r) {
      return isam.tree.row_clique[r] >= 0 && !isam.forgotten[r];
    });
    for (Index child = clique.first_child; child >= 0; child = isam.tree.cliques[child].next) {
      if (isam.tree.cliques[child].marked != isam.updates) work.orphans.push_back(child);
    }
  }
  std::ranges::sort(work.variables);
  std::ranges::sort(work.rows);
}

// The pattern of the top, with its variables numbered by their place in work.variables: its rows,
// then a row for what each orphan passes up.
void make_pattern(Isam2& isam) {
  Isam2::Work& work = isam.work;
  const graph::Pattern& whole = pattern_of(isam);
  graph::Pattern& pattern = work.pattern;
  pattern.dim.clear();
  pattern.rows.clear();
  for (Index k = 0; k < static_cast<Index>(work.variables.size()); ++k) {
    work.local[work.variables[k]] = k;
    pattern.dim.push_back(whole.dim[work.variables[k]]);
  }
  const auto add = [&](std::span<const Index> row) {
    for (Index j : row) pattern.rows.items.push_back(work.local[j]);
    pattern.rows.close();
  };
  for (Index r : work.rows) add(whole.rows[r]);
  for (Index c : work.orphans) add(separators_of(isam.tree, isam.tree.cliques[c]));
}

void take_out(Isam2& isam) {
  for (Index c : isam.work.orphans) unlink(isam.tree, c);
  for (Index c : isam.work.marked) remove_clique(isam.tree, c);
}

// The new factors' variables go last, where the next ones will be close to the root.
graph::Order order_top(Isam2& isam, std::span<const Index> new_rows, Last last) {
  Isam2::Work& work = isam.work;
  order::OrderOptions options;
  options.budget = isam.options.order_budget;
  const factor::Problem& problem = *isam.problem;
  const auto goes_last = [&](Index j) {
    return !isam.leaving[j] &&
           (last == Last::all ||
            problem.graph->role(problem.variables.variable_vertex[j]) == graph::Role::pose);
  };
  for (Index r : new_rows) {
    for (Index j : pattern_of(isam).rows[r]) {
      if (goes_last(j)) options.last.push_back(work.local[j]);
    }
  }
  std::ranges::sort(options.last);
  options.last.erase(std::unique(options.last.begin(), options.last.end()), options.last.end());
  std::vector<Index> first;
  for (Index k = 0; k < work.pattern.variables(); ++k) {
    if (isam.leaving[work.variables[k]]) first.push_back(k);
  }
  return first.empty() ? order::elimination_order(isam.options.ordering, work.pattern, options)
                       : order_after(isam.options, work.pattern, first, options.last);
}

// Adds clique k of the top's tree to the smoother's: work.variables and work.rows say what its
// numbers mean there. leaf: nothing will hang below it.
Index adopt_clique(Isam2& isam, const CliqueTree& top, Index k, std::span<const Index> rows,
                   bool leaf) {
  const Isam2::Work& work = isam.work;
  const auto frontals = top.frontals[k], separators = top.separators[k];
  Isam2Clique sizes;
  sizes.frontals = static_cast<Index>(frontals.size());
  sizes.separators = static_cast<Index>(separators.size());
  sizes.rows = static_cast<Index>(rows.size());
  sizes.f = top.frontal_dim[k];
  sizes.s = top.separator_dim[k];
  sizes.ec = top.ec[k];
  sizes.merged = top.merged[k];
  sizes.made = isam.updates;
  sizes.factor = leaf && stays_factor(sizes.f, sizes.s);
  const Index c = add_clique(isam.tree, sizes);
  auto to = lists_of(isam.tree, isam.tree.cliques[c]).begin();
  for (Index j : frontals) {
    isam.tree.variable_clique[work.variables[j]] = c;
    *to++ = work.variables[j];
  }
  for (Index j : separators) *to++ = work.variables[j];
  for (Index r : rows) {
    isam.tree.row_clique[work.rows[r]] = c;
    *to++ = work.rows[r];
  }
  return c;
}

// The top's cliques, linked to one another and to the orphans, without numbers yet.
void adopt_cliques(Isam2& isam, const CliqueTree& top) {
  Isam2::Work& work = isam.work;
  const auto factors = static_cast<Index>(work.rows.size());
  const graph::Lists<> rows = graph::grouped(top.row_clique, top.cliques());  // then orphans
  const std::vector<bool> leaf = childless(top.parent);
  work.made.clear();
  for (Index k = 0; k < top.cliques(); ++k) {
    const auto end = std::ranges::lower_bound(rows[k], factors);
    const bool alone = leaf[k] && end == rows[k].end();  // no orphans either
    work.made.push_back(adopt_clique(isam, top, k, {rows[k].begin(), end}, alone));
  }
  grow_numbers(isam.tree);
  for (Index k = 0; k < top.cliques(); ++k)
    link(isam.tree, work.made[k], top.parent[k] < 0 ? -1 : work.made[top.parent[k]]);
  for (std::size_t i = 0; i < work.orphans.size(); ++i)
    link(isam.tree, work.orphans[i], work.made[top.row_clique[factors + i]]);
}

}  // namespace

void take_row_out(Isam2& isam, Index r) {
  mark_to_root(isam, isam.tree.row_clique[r]);
  let_row_go(isam, r);
}

void take_variable_out(Isam2& isam, Index j) {
  mark_to_root(isam, isam.tree.variable_clique[j]);
  isam.tree.variable_clique[j] = -1;
  --isam.variables;
}

CliqueTree plan_top(Isam2& isam, std::span<const Index> new_variables,
                    std::span<const Index> new_rows, Last last) {
  mark_all_if_many(isam);
  gather_top(isam, new_variables, new_rows);
  make_pattern(isam);
  return clique_tree(isam.work.pattern, order_top(isam, new_rows, last), isam.options.relaxed_from);
}

void redo_and_solve(Isam2& isam, std::span<const Index> new_variables,
                    std::span<const Index> new_rows, const CliqueTree& plan, Isam2Report& report) {
  isam.variables += static_cast<Index>(new_variables.size());
  isam.rows += static_cast<Index>(new_rows.size());
  report.reeliminated = static_cast<Index>(isam.work.variables.size());
  take_out(isam);
  adopt_cliques(isam, plan);
  for (Index c : isam.work.made) {
    report.ec += static_cast<elim::Wide>(isam.tree.cliques[c].ec);
    eliminate_clique(isam, c, report.undetermined);
  }
  std::ranges::sort(report.undetermined);
  if (report.undetermined.empty()) report.finite = solve_down(isam) && report.finite;
}

}  // namespace sg::solve
