#include <algorithm>

#include "lib/solve/assembly.h"
#include "lib/solve/clique_tree.h"
#include "lib/solve/isam2_steps.h"

namespace sg::solve {
namespace {

// Beyond this share of all variables, the others come along: a new ordering pays.
constexpr double reorder_all = 0.65;

void mark_all_if_many(Isam2& isam) {
  Index redone = 0;
  for (Index c : isam.work.marked) redone += isam.tree.cliques[c].frontals;
  if (redone <= reorder_all * isam.variables) return;
  for (Index c : isam.tree.variable_clique) mark_to_root(isam, c);
}

// Cuts the subtrees below the marked cliques off.
void cut_orphans(Isam2& isam) {
  Isam2Tree& tree = isam.tree;
  isam.work.orphans.clear();
  for (Index c : isam.work.marked) {
    for (Index child = tree.cliques[c].first_child; child >= 0;) {
      const Index next = tree.cliques[child].next;
      if (tree.cliques[child].marked != isam.updates) {
        unlink(tree, child);
        isam.work.orphans.push_back(child);
      }
      child = next;
    }
  }
}

// Adds what the marked cliques held to the variables and rows of the top, and takes them out.
void take_out(Isam2& isam) {
  Isam2::Work& work = isam.work;
  for (Index c : work.marked) {
    const Isam2Clique& clique = isam.tree.cliques[c];
    const auto frontals = frontals_of(isam.tree, clique);
    const auto rows = rows_of(isam.tree, clique);
    work.variables.insert(work.variables.end(), frontals.begin(), frontals.end());
    work.rows.insert(work.rows.end(), rows.begin(), rows.end());
    remove_clique(isam.tree, c);
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

// The new factors' variables go last, where the next ones will be close to the root.
graph::Order order_top(Isam2& isam, std::span<const Index> new_rows) {
  Isam2::Work& work = isam.work;
  order::OrderOptions options;
  for (Index r : new_rows) {
    for (Index j : pattern_of(isam).rows[r]) options.last.push_back(work.local[j]);
  }
  std::ranges::sort(options.last);
  const auto doubles = std::ranges::unique(options.last);
  options.last.erase(doubles.begin(), doubles.end());
  return order::elimination_order(isam.options.ordering, work.pattern, options);
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
  std::vector<bool> leaf(top.cliques(), true);
  for (Index p : top.parent) {
    if (p >= 0) leaf[p] = false;
  }
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

void redo_top(Isam2& isam, std::span<const Index> new_variables, std::span<const Index> new_rows,
              Isam2Report& report) {
  Isam2::Work& work = isam.work;
  mark_all_if_many(isam);
  isam.variables += static_cast<Index>(new_variables.size());
  isam.rows += static_cast<Index>(new_rows.size());
  work.variables.assign(new_variables.begin(), new_variables.end());
  work.rows.assign(new_rows.begin(), new_rows.end());
  cut_orphans(isam);
  take_out(isam);
  report.reeliminated = static_cast<Index>(work.variables.size());
  make_pattern(isam);
  adopt_cliques(isam, clique_tree(work.pattern, order_top(isam, new_rows), false));
  for (Index c : work.made) eliminate_clique(isam, c, report.undetermined);
  std::ranges::sort(report.undetermined);
}

}  // namespace sg::solve
