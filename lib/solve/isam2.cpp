#include "lib/solve/isam2.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "lib/solve/clique_tree.h"
#include "lib/solve/landmark_point.h"

namespace sg {
namespace {

// Beyond this share of all variables, the others come along: a new ordering pays.
constexpr double reorder_all = 0.65;

const Pattern& pattern_of(const Isam2& isam) {
  return isam.problem->variables.pattern;
}

int height(const Isam2& isam, Index r) {
  const Problem& problem = *isam.problem;
  const bool gauge = r >= problem.graph->edges();
  return gauge ? problem.variables.pattern.dim[problem.held] : problem.model[r]->dim;
}

int width(const Pattern& pattern, Index r) {
  int sum = 1;
  for (Index j : pattern.rows[r]) sum += pattern.dim[j];
  return sum;
}

std::span<const Index> frontals_of(const Isam2& isam, const Isam2Clique& c) {
  return {isam.lists.data() + c.lists, static_cast<std::size_t>(c.frontals)};
}
std::span<const Index> separators_of(const Isam2& isam, const Isam2Clique& c) {
  return {isam.lists.data() + c.lists + c.frontals, static_cast<std::size_t>(c.separators)};
}
std::span<const Index> rows_of(const Isam2& isam, const Isam2Clique& c) {
  return {isam.lists.data() + c.lists + c.frontals + c.separators,
          static_cast<std::size_t>(c.rows)};
}

Offset list_size(const Isam2Clique& c) {
  return c.frontals + c.separators + c.rows;
}
Offset number_size(const Isam2Clique& c) {
  const Front front{nullptr, nullptr, c.f, c.f + c.s + 1};
  return front.size_l() + front.size_u();
}

Front front_of(Isam2& isam, const Isam2Clique& c) {
  Front front{isam.numbers.at(c.numbers), nullptr, c.f, c.f + c.s + 1};
  front.u = front.l + front.size_l();
  return front;
}

// The next relinearization looks at variable j.
void propose(Isam2& isam, Index j) {
  if (isam.moved[j]) return;
  isam.moved[j] = true;
  isam.candidates.push_back(j);
}

// A landmark seen along a ray is damped, and where it cannot be seen the row says nothing of it.
void damp_ray(Isam2& isam, Index r, double* gram) {
  const Problem& problem = *isam.problem;
  const Pattern& pattern = pattern_of(isam);
  const int w = width(pattern, r);
  const double distance = ray_distance(problem, r, isam.linearized);
  const bool unseen = distance < nearest_seen;
  if (unseen) std::fill_n(gram, w * w, 0.0);
  int column = 0;
  for (Index j : pattern.rows[r]) {
    const bool landmark =
        problem.graph->role(problem.variables.variable_vertex[j]) == Role::landmark;
    if (landmark && unseen) {
      isam.unseen[j] = true;
      propose(isam, j);
    }
    for (int k = 0; k < pattern.dim[j]; ++k, ++column) {
      if (landmark) gram[column * (w + 1)] += ray_damping(distance);
    }
  }
}

void linearize(Isam2& isam, Index r) {
  const Pattern& pattern = pattern_of(isam);
  const int h = height(isam, r), w = width(pattern, r);
  isam.work.numbers.resize(h * w + w * w + lane + h * (w + lane));
  double* const block = isam.work.numbers.data();
  double* const gram = block + h * w;
  linearize_row(*isam.problem, isam.linearized, {}, r, block);
  kernels().gram(block, h, w, gram, gram + w * w + lane);
  const bool ray = r < isam.problem->graph->edges() && sees_along_ray(*isam.problem, r);
  if (ray) damp_ray(isam, r, gram);
  std::copy_n(gram, w * w, isam.grams.data() + isam.gram_at[r]);
  isam.row_update[r] = isam.updates;
  int column = 0;
  for (Index j : pattern.rows[r]) {
    for (int k = 0; k < pattern.dim[j]; ++k, ++column) {
      double& floor = isam.floor[isam.problem->step_at[j] + k];
      floor = std::max(floor, vanishing * gram[column * (w + 1)]);
    }
  }
}

double largest(const Isam2& isam, Index j) {
  double most = 0;
  for (Index k = isam.problem->step_at[j]; k < isam.problem->step_at[j + 1]; ++k)
    most = std::max(most, std::abs(isam.step[k]));
  return most;
}

void remove_up(Isam2& isam, Index c) {
  for (; c >= 0 && isam.cliques[c].removed != isam.updates; c = isam.cliques[c].parent) {
    isam.cliques[c].removed = isam.updates;
    isam.work.removed.push_back(c);
  }
}

// Moves the linearization point of a variable by its step.
void move_point(Isam2& isam, Index j) {
  const Problem& problem = *isam.problem;
  const Index v = problem.variables.variable_vertex[j];
  const auto rows = isam.rows_of[j];
  std::vector<Index>& edges = isam.work.edges;
  edges.clear();
  std::ranges::copy_if(rows, std::back_inserter(edges), [&](Index r) {
    return isam.row_clique[r] >= 0 && r < problem.graph->edges();
  });
  double* const point = isam.linearized.data() + problem.value_at[v];
  const bool by_rays =
      problem.graph->role(v) == Role::landmark &&
      std::ranges::any_of(edges, [&](Index e) { return sees_along_ray(problem, e); });
  if (by_rays) {
    const std::span<const double> step(isam.step.data() + problem.step_at[j],
                                       static_cast<std::size_t>(pattern_of(isam).dim[j]));
    move_landmark(problem, v, edges, step, isam.estimate, point);
  } else {
    std::copy(isam.estimate.begin() + problem.value_at[v],
              isam.estimate.begin() + problem.value_at[v + 1], point);
  }
  for (Index k = problem.step_at[j]; k < problem.step_at[j + 1]; ++k)
    isam.step[k] = isam.told[k] = 0;
}

// Moves the linearization points of the variables that have gone too far, linearizes their rows
// again, and takes out the cliques in which these stand. Returns how many variables moved.
Index relinearize(Isam2& isam) {
  if (isam.options.relinearize_skip <= 0 || isam.updates % isam.options.relinearize_skip != 0)
    return 0;
  std::vector<Index>& moved = isam.work.variables;
  moved.clear();
  for (Index j : isam.candidates) {
    isam.moved[j] = false;
    if (largest(isam, j) < isam.options.relinearize_threshold && !isam.unseen[j]) continue;
    isam.unseen[j] = false;
    move_point(isam, j);
    moved.push_back(j);
  }
  isam.candidates.clear();
  for (Index j : moved) {  // all their rows are linearized anew
    std::fill(isam.floor.begin() + isam.problem->step_at[j],
              isam.floor.begin() + isam.problem->step_at[j + 1], 0.0);
  }
  for (Index j : moved) {
    remove_up(isam, isam.clique[j]);
    for (Index r : isam.rows_of[j]) {
      if (isam.row_clique[r] < 0 || isam.row_update[r] == isam.updates) continue;
      linearize(isam, r);
      remove_up(isam, isam.row_clique[r]);
    }
  }
  return static_cast<Index>(moved.size());
}

void unlink(Isam2& isam, Index c) {
  Isam2Clique& clique = isam.cliques[c];
  if (clique.previous >= 0) {
    isam.cliques[clique.previous].next = clique.next;
  } else if (clique.parent >= 0) {
    isam.cliques[clique.parent].first_child = clique.next;
  }
  if (clique.next >= 0) isam.cliques[clique.next].previous = clique.previous;
  clique.parent = clique.next = clique.previous = -1;
}

void link(Isam2& isam, Index c, Index parent) {
  Isam2Clique& clique = isam.cliques[c];
  clique.parent = parent;
  clique.next = clique.previous = -1;
  if (parent < 0) return;
  clique.next = isam.cliques[parent].first_child;
  if (clique.next >= 0) isam.cliques[clique.next].previous = c;
  isam.cliques[parent].first_child = c;
}

// Collects what the removed cliques held: their variables and rows, and the subtrees below. Gives
// their blocks back.
void take_out(Isam2& isam) {
  Isam2::Work& work = isam.work;
  for (Index c : work.removed) {
    for (Index child = isam.cliques[c].first_child; child >= 0;) {
      const Index next = isam.cliques[child].next;
      if (isam.cliques[child].removed != isam.updates) {
        unlink(isam, child);
        work.orphans.push_back(child);
      }
      child = next;
    }
  }
  for (Index c : work.removed) {
    const Isam2Clique& clique = isam.cliques[c];
    const auto frontals = frontals_of(isam, clique);
    const auto rows = rows_of(isam, clique);
    work.variables.insert(work.variables.end(), frontals.begin(), frontals.end());
    work.rows.insert(work.rows.end(), rows.begin(), rows.end());
    isam.ec_bt -= static_cast<Wide>(clique.ec);
    --isam.clique_count;
    isam.list_pool.give(clique.lists, list_size(clique));
    isam.number_pool.give(clique.numbers, number_size(clique));
    isam.free_cliques.push_back(c);
  }
}

Index removed_variables(const Isam2& isam) {
  Index sum = 0;
  for (Index c : isam.work.removed) sum += isam.cliques[c].frontals;
  return sum;
}

void remove_all(Isam2& isam) {
  for (Index j = 0; j < static_cast<Index>(isam.clique.size()); ++j) {
    if (isam.clique[j] >= 0) remove_up(isam, isam.clique[j]);
  }
}

// The pattern of the affected part, with its variables numbered by their place in work.variables:
// its rows, then a row for what each orphan passes up.
void make_pattern(Isam2& isam) {
  Isam2::Work& work = isam.work;
  const Pattern& whole = pattern_of(isam);
  std::sort(work.variables.begin(), work.variables.end());
  std::sort(work.rows.begin(), work.rows.end());
  Pattern& pattern = work.pattern;
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
  for (Index c : work.orphans) add(separators_of(isam, isam.cliques[c]));
}

// The new factors' variables go last, where the next ones will be close to the root.
Order order_affected(Isam2& isam, std::span<const Index> new_rows) {
  Isam2::Work& work = isam.work;
  OrderOptions options;
  for (Index r : new_rows) {
    for (Index j : pattern_of(isam).rows[r]) options.last.push_back(work.local[j]);
  }
  std::sort(options.last.begin(), options.last.end());
  options.last.erase(std::unique(options.last.begin(), options.last.end()), options.last.end());
  return elimination_order(isam.options.ordering, work.pattern, options);
}

Index new_clique(Isam2& isam) {
  if (isam.free_cliques.empty()) {
    isam.cliques.emplace_back();
    return static_cast<Index>(isam.cliques.size()) - 1;
  }
  const Index c = isam.free_cliques.back();
  isam.free_cliques.pop_back();
  isam.cliques[c] = {};
  return c;
}

// Lists of a new clique: work.variables and work.rows say what the tree's numbers mean.
void fill_lists(Isam2& isam, const CliqueTree& tree, Index k, std::span<const Index> rows) {
  const Isam2::Work& work = isam.work;
  Isam2Clique& clique = isam.cliques[work.made[k]];
  const auto frontals = tree.frontals_of(k), separators = tree.separators_of(k);
  clique.frontals = static_cast<Index>(frontals.size());
  clique.separators = static_cast<Index>(separators.size());
  clique.rows = static_cast<Index>(rows.size());
  clique.lists = isam.list_pool.take(list_size(clique));
  if (isam.list_pool.end() > static_cast<Offset>(isam.lists.size()))
    isam.lists.resize(2 * isam.list_pool.end());
  Index* to = isam.lists.data() + clique.lists;
  for (Index j : frontals) {
    isam.clique[work.variables[j]] = work.made[k];
    *to++ = work.variables[j];
  }
  for (Index j : separators) *to++ = work.variables[j];
  for (Index r : rows) {
    isam.row_clique[work.rows[r]] = work.made[k];
    *to++ = work.rows[r];
  }
}

// Cliques of the tree, linked to one another and to the orphans, without numbers yet.
void make_cliques(Isam2& isam, const CliqueTree& tree) {
  Isam2::Work& work = isam.work;
  const auto factors = static_cast<Index>(work.rows.size());
  work.made.clear();
  for (Index k = 0; k < tree.cliques(); ++k) work.made.push_back(new_clique(isam));
  // Rows by clique, by counting.
  std::vector<Index> begin(tree.cliques() + 1, 0);
  for (Index r = 0; r < factors; ++r) ++begin[tree.row_clique[r] + 1];
  for (Index k = 0; k < tree.cliques(); ++k) begin[k + 1] += begin[k];
  std::vector<Index> sorted(factors);
  std::vector<Index> at(begin.begin(), begin.end() - 1);
  for (Index r = 0; r < factors; ++r) sorted[at[tree.row_clique[r]]++] = r;

  for (Index k = 0; k < tree.cliques(); ++k) {
    fill_lists(isam, tree, k, std::span(sorted).subspan(begin[k], begin[k + 1] - begin[k]));
    Isam2Clique& clique = isam.cliques[work.made[k]];
    clique.f = tree.frontal_dim[k];
    clique.s = tree.separator_dim[k];
    clique.ec = tree.ec[k];
    clique.made = isam.updates;
    clique.numbers = isam.number_pool.take(number_size(clique));
    isam.ec_bt += static_cast<Wide>(clique.ec);
    ++isam.clique_count;
    link(isam, work.made[k], tree.parent[k] < 0 ? -1 : work.made[tree.parent[k]]);
  }
  isam.numbers.grow(isam.number_pool.end());
  for (std::size_t i = 0; i < work.orphans.size(); ++i)
    link(isam, work.orphans[i], work.made[tree.row_clique[factors + i]]);
}

// The front's rows that the variables stand in, by variable.
int place_variables(Isam2& isam, const Isam2Clique& clique) {
  const Pattern& pattern = pattern_of(isam);
  int row = 0;
  for (const auto& variables : {frontals_of(isam, clique), separators_of(isam, clique)}) {
    for (Index j : variables) {
      isam.work.row_at[j] = row;
      row += pattern.dim[j];
    }
  }
  return row;
}

// work.runs: from a matrix over `variables` (and the right-hand side) to the front at hand.
void make_runs(Isam2& isam, std::span<const Index> variables, int last_row) {
  std::vector<Run>& runs = isam.work.runs;
  runs.clear();
  int from = 0;
  const auto add = [&](int to, int length) {
    const bool goes_on = !runs.empty() && runs.back().from + runs.back().length == from &&
                         runs.back().to + runs.back().length == to;
    if (goes_on) {
      runs.back().length += length;
    } else {
      runs.push_back({from, to, length});
    }
    from += length;
  };
  for (Index j : variables) add(isam.work.row_at[j], pattern_of(isam).dim[j]);
  add(last_row, 1);
}

bool ascending(const std::vector<Run>& runs) {
  return std::ranges::is_sorted(runs, {}, &Run::to);
}

// Writes the lower triangle of an update above its diagonal, too.
void mirror(const Front& front) {
  const std::int64_t ld = front.ld_u();
  for (int j = 0; j < front.n - front.f; ++j) {
    for (int i = j + 1; i < front.n - front.f; ++i) front.u[i * ld + j] = front.u[j * ld + i];
  }
}

void eliminate(Isam2& isam, Index c, const Kernels& kernel, Isam2Report& report) {
  const Isam2Clique& clique = isam.cliques[c];
  std::vector<Run>& runs = isam.work.runs;
  const Front front = front_of(isam, clique);
  const int last_row = place_variables(isam, clique);
  kernel.clear(front);
  for (Index r : rows_of(isam, clique)) {
    const auto variables = pattern_of(isam).rows[r];
    make_runs(isam, variables, last_row);
    std::ranges::sort(runs, {}, &Run::to);
    kernel.add(front, isam.grams.data() + isam.gram_at[r], width(pattern_of(isam), r), runs.data(),
               static_cast<int>(runs.size()));
  }
  for (Index child = clique.first_child; child >= 0; child = isam.cliques[child].next) {
    make_runs(isam, separators_of(isam, isam.cliques[child]), last_row);
    const Front from = front_of(isam, isam.cliques[child]);
    if (!ascending(runs)) {  // an orphan, whose separator has been ordered anew
      mirror(from);
      std::ranges::sort(runs, {}, &Run::to);
    }
    kernel.add(front, from.u, from.ld_u(), runs.data(), static_cast<int>(runs.size()));
  }
  std::vector<double>& floors = isam.work.floors;
  floors.clear();
  for (Index j : frontals_of(isam, clique)) {
    for (int k = 0; k < pattern_of(isam).dim[j]; ++k)
      floors.push_back(isam.floor[isam.problem->step_at[j] + k]);
  }
  if (kernel.factorize(front, floors.data()) == 0) return;
  int row = 0;
  for (Index j : frontals_of(isam, clique)) {
    bool dropped = false;
    for (int k = 0; k < pattern_of(isam).dim[j]; ++k, ++row)
      dropped |= front.l[row * (front.ld_l() + 1)] == 0;
    if (dropped) report.undetermined.push_back(j);
  }
}

bool separator_changed(const Isam2& isam, const Isam2Clique& clique) {
  return std::ranges::any_of(separators_of(isam, clique),
                             [&](Index j) { return isam.changed[j] == isam.updates; });
}

// Solves for the frontal variables into work.numbers; returns how far, at most, they are from what
// was last passed down.
double solve(Isam2& isam, const Isam2Clique& clique, const Kernels& kernel) {
  const Front front = front_of(isam, clique);
  std::vector<double>& x = isam.work.numbers;
  x.assign(front.ld_l(), 0.0);
  const std::vector<Index>& at = isam.problem->step_at;
  int row = front.f;
  for (Index j : separators_of(isam, clique)) {
    for (Index k = at[j]; k < at[j + 1]; ++k) x[row++] = isam.step[k];
  }
  x[row] = -1;
  kernel.back_substitute(front, x.data());
  double change = 0;
  row = 0;
  for (Index j : frontals_of(isam, clique)) {
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

// Takes the solution in work.numbers over, and brings the estimates up to date.
void accept(Isam2& isam, const Isam2Clique& clique) {
  const Problem& problem = *isam.problem;
  const double* x = isam.work.numbers.data();
  for (Index j : frontals_of(isam, clique)) {
    const int dim = pattern_of(isam).dim[j];
    std::copy_n(x, dim, isam.step.begin() + problem.step_at[j]);
    x += dim;
    tell(isam, j);
    const Index v = problem.variables.variable_vertex[j];
    std::copy(isam.linearized.begin() + problem.value_at[v],
              isam.linearized.begin() + problem.value_at[v + 1],
              isam.estimate.begin() + problem.value_at[v]);
    retract(problem.space[v], isam.step.data() + problem.step_at[j],
            isam.estimate.data() + problem.value_at[v]);
    if (largest(isam, j) >= isam.options.relinearize_threshold) propose(isam, j);
  }
}

// From the new roots down to where nothing changes.
void solve_down(Isam2& isam) {
  const Kernels& kernel = kernels();
  std::vector<Index>& stack = isam.work.stack;
  stack.clear();
  for (Index c : isam.work.made) {
    if (isam.cliques[c].parent < 0) stack.push_back(c);
  }
  while (!stack.empty()) {
    const Isam2Clique& clique = isam.cliques[stack.back()];
    stack.pop_back();
    const bool made = clique.made == isam.updates;
    if (!made && !separator_changed(isam, clique)) continue;
    const double change = solve(isam, clique, kernel);
    if (made || change >= isam.options.wildfire_threshold) accept(isam, clique);
    for (Index child = clique.first_child; child >= 0; child = isam.cliques[child].next)
      stack.push_back(child);
  }
}

}  // namespace

Isam2 make_isam2(const Problem& problem, const Isam2Options& options) {
  find_ordering(options.ordering);
  Isam2 isam;
  isam.problem = &problem;
  isam.options = options;
  const Pattern& pattern = problem.variables.pattern;
  const Index n = pattern.variables();
  isam.rows_of = columns(pattern);
  isam.clique.assign(n, -1);
  isam.step.assign(problem.step_at.back(), 0.0);
  isam.told = isam.step;
  isam.floor.assign(problem.step_at.back(), 0.0);
  isam.changed.assign(n, -1);
  isam.moved.assign(n, false);
  isam.unseen.assign(n, false);
  isam.linearized.assign(problem.value_at.back(), 0.0);
  isam.estimate = isam.linearized;
  isam.row_clique.assign(pattern.rows.size(), -1);
  isam.row_update.assign(pattern.rows.size(), -1);
  isam.gram_at.assign(1, 0);
  for (Index r = 0; r < pattern.rows.size(); ++r) {
    const Offset w = width(pattern, r);
    isam.gram_at.push_back(isam.gram_at.back() + w * w);
  }
  isam.grams.resize(isam.gram_at.back());
  isam.work.local.assign(n, -1);
  isam.work.row_at.assign(n, -1);
  return isam;
}

Isam2Report update(Isam2& isam, std::span<const Index> variables, std::span<const Index> rows) {
  Isam2Report report;
  Isam2::Work& work = isam.work;
  ++isam.updates;
  work.removed.clear();
  work.orphans.clear();
  report.relinearized = relinearize(isam);
  for (Index r : rows) {
    linearize(isam, r);
    for (Index j : pattern_of(isam).rows[r]) remove_up(isam, isam.clique[j]);
  }
  if (removed_variables(isam) > reorder_all * isam.variables) remove_all(isam);
  isam.variables += static_cast<Index>(variables.size());
  isam.rows += static_cast<Index>(rows.size());

  work.variables.assign(variables.begin(), variables.end());
  work.rows.assign(rows.begin(), rows.end());
  take_out(isam);
  report.reeliminated = static_cast<Index>(work.variables.size());
  make_pattern(isam);
  make_cliques(isam, clique_tree(work.pattern, order_affected(isam, rows), false));
  for (Index c : work.made) eliminate(isam, c, kernels(), report);
  std::sort(report.undetermined.begin(), report.undetermined.end());
  if (report.undetermined.empty()) solve_down(isam);
  return report;
}

double chi2(const Isam2& isam) {
  double sum = 0;
  for (Index e = 0; e < isam.problem->graph->edges(); ++e) {
    if (isam.row_clique[e] >= 0) sum += edge_chi2(*isam.problem, isam.estimate, e);
  }
  return sum;
}

}  // namespace sg
