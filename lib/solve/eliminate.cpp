#include "lib/solve/eliminate.h"

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <numeric>

#include "lib/parallel/parallel.h"
#include "lib/solve/assembly.h"
#include "lib/solve/factorize.h"
#include "lib/solve/pivots.h"
#include "lib/solve/update_stacks.h"

namespace sg::solve {
namespace {

// Which cliques form an update.
void plan_leaves(Elimination& e) {
  e.u_at.assign(e.tree.cliques(), 0);
  for (Index c = 0; c < e.tree.cliques(); ++c) {
    if (e.children[c].empty() && stays_factor(e.tree.frontal_dim[c], e.tree.separator_dim[c]))
      e.u_at[c] = -1;
  }
}

// Where rows and children go in their clique's front.
void plan_runs(const graph::Pattern& pattern, Elimination& e) {
  const CliqueTree& tree = e.tree;
  // No more runs than variables and right-hand sides.
  const std::size_t rows = e.rows.items.size(), children = e.children.items.size();
  e.row_runs.begin.reserve(rows + 1);
  e.row_runs.items.reserve(pattern.rows.items.size() + rows);
  e.child_runs.begin.reserve(children + 1);
  e.child_runs.items.reserve(tree.separators.items.size() + children);
  std::vector<int> row_at(pattern.variables(), -1);
  for (Index c = 0; c < tree.cliques(); ++c) {
    const int last_row = place_variables(tree.frontals[c], tree.separators[c], pattern.dim, row_at);
    for (Index r : e.rows[c]) {
      append_runs(pattern.rows[r], pattern.dim, row_at, last_row, e.row_runs.items);
      e.row_runs.close();
    }
    for (Index child : e.children[c]) {
      append_runs(tree.separators[child], pattern.dim, row_at, last_row, e.child_runs.items);
      e.child_runs.close();
      if (e.u_at[child] >= 0) continue;
      for (Index j : tree.frontals[child]) row_at[j] = -1;
      for (Index r : e.rows[child]) {
        e.rest.items.push_back(r);
        append_runs(pattern.rows[r], pattern.dim, row_at, last_row, e.rest_runs.items);
        e.rest_runs.close();
      }
    }
    e.rest.close();
  }
}

void plan_scalars(const graph::Pattern& pattern, Elimination& e) {
  e.dim = pattern.dim;
  e.step_at = factor::starts(pattern.dim);
  e.floor_at.resize(pattern.variables());
  Index scalar = 0;
  for (Index j : e.tree.frontals.items) {
    e.floor_at[j] = scalar;
    scalar += pattern.dim[j];
  }
  e.floors.resize(scalar);
}

// Multiplications of a clique, roughly.
double work(const CliqueTree& tree, Index c) {
  const double n = tree.frontal_dim[c] + tree.separator_dim[c] + 1;
  return 500 + tree.frontal_dim[c] * n * n;
}

// One task for all, or the largest subtrees that leave work for every thread, and one task for each
// clique above them.
void plan_tasks(Elimination& e, int threads) {
  const CliqueTree& tree = e.tree;
  const Index cliques = tree.cliques();
  e.threads = threads;
  if (threads <= 1) {
    if (cliques > 0) e.tasks.push_back({0, cliques - 1, -1, 0});
    return;
  }
  std::vector<double> below(cliques, 0);  // of the subtree
  std::vector<Index> first(cliques);      // clique of the subtree
  std::iota(first.begin(), first.end(), 0);
  double total = 0;
  for (Index c = 0; c < cliques; ++c) {
    below[c] += work(tree, c);
    total += work(tree, c);
    const Index p = tree.parent[c];
    if (p < 0) continue;
    below[p] += below[c];
    first[p] = std::min(first[p], first[c]);
  }
  const double most = total / (8 * threads);
  std::vector<Index> task(cliques, -1);
  for (Index c = 0; c < cliques; ++c) {
    const Index p = tree.parent[c];
    const bool large = below[c] > most;
    if (!large && p >= 0 && below[p] <= most) continue;  // within a larger subtree
    task[c] = static_cast<Index>(e.tasks.size());
    e.tasks.push_back({large ? c : first[c], c, -1, 0});
  }
  for (Elimination::Task& t : e.tasks) {
    const Index p = tree.parent[t.last];
    if (p < 0) continue;
    t.parent = task[p];
    ++e.tasks[t.parent].children;
  }
}

void plan_storage(const factor::LinearSystem& system, Elimination& e) {
  const Index cliques = e.tree.cliques();
  e.l_at.resize(cliques);
  Offset l = 0;
  int rows = 0;
  const std::vector<int> depth = depths(e.tree.parent);
  for (Index c = 0; c < cliques; ++c) {
    const Front front = e.front(c);
    e.l_at[c] = l;
    l += front.size_l();
    rows = std::max(rows, front.ld_l());
    e.scratch_size = std::max(e.scratch_size, factorization_work(kernels(), front.f, front.n));
  }
  Offset u = 0;
  for (const Elimination::Task& task : e.tasks) {
    u = place_updates(
        task.first, task.last, e.children, depth, u, [&](Index c) { return e.front(c).size_u(); },
        e.u_at);
  }
  e.conditionals = Arena(l + lane);
  e.updates = Arena(u + lane);

  e.scratch_size = std::max<std::size_t>(e.scratch_size, rows + lane);
  for (Index i = 0; i < e.row_runs.size(); ++i) {
    const std::size_t height = system.height[e.rows.items[i]];
    const std::size_t width = rows_covered(e.row_runs[i]);
    e.scratch_size = std::max(e.scratch_size, width * width + lane + height * (width + lane));
  }
  e.scratch_size = (e.scratch_size + lane - 1) / lane * lane;
  e.scratch = Arena(e.scratch_size * std::max(e.threads, 1));
}

void damp(const Elimination& e, Index c, std::span<const double> damping, const Front& front) {
  int row = 0;
  for (Index j : e.tree.frontals[c]) {
    for (int k = 0; k < e.dim[j]; ++k, ++row) front.pivot(row) += damping[e.step_at[j] + k];
  }
}

void add_row(const factor::LinearSystem& system, Index r, std::span<const Run> runs,
             const Front& front, const Kernels& kernel, double* scratch) {
  const int width = rows_covered(runs);
  kernel.gram(system.block(r), system.height[r], width, scratch,
              scratch + std::int64_t{width} * width + lane);
  kernel.add(front, scratch, width, runs.data(), static_cast<int>(runs.size()));
}

// The place in `children` of clique c's child with the largest update, -1 without one.
Index largest_child(const Elimination& e, Index c) {
  Index largest = -1;
  int size = -1;
  for (Index i = e.children.begin[c]; i < e.children.begin[c + 1]; ++i) {
    const Index child = e.children.items[i];
    if (e.u_at[child] < 0 || e.tree.separator_dim[child] <= size) continue;
    largest = i;
    size = e.tree.separator_dim[child];
  }
  return largest;
}

// Gathers and eliminates one clique; returns how many of its pivots vanished.
int eliminate_clique(Elimination& e, const factor::LinearSystem& system,
                     std::span<const double> damping, Index c, const Kernels& kernel,
                     double* scratch) {
  const Front front = e.front(c);
  const Index first = largest_child(e, c);
  if (first < 0) {
    kernel.clear(front);
  } else {
    start_with(kernel, e.front(e.children.items[first]), e.child_runs[first], front);
  }
  for (Index i = e.rows.begin[c]; i < e.rows.begin[c + 1]; ++i)
    add_row(system, e.rows.items[i], e.row_runs[i], front, kernel, scratch);
  for (Index i = e.rest.begin[c]; i < e.rest.begin[c + 1]; ++i)
    add_row(system, e.rest.items[i], e.rest_runs[i], front, kernel, scratch);
  if (!damping.empty()) damp(e, c, damping, front);
  for (Index i = e.children.begin[c]; i < e.children.begin[c + 1]; ++i) {
    if (i != first) add_child(kernel, e.front(e.children.items[i]), e.child_runs[i], front);
  }
  const double* const floor = e.floors.data() + e.floor_at[e.tree.frontals[c].front()];
  return factorize(kernel, front, floor, scratch, e.threads);
}

// Runs the tasks, children before parents, on as many threads as were planned.
template <class Work>
void run_tasks(const Elimination& e, Work&& work) {
  const auto tasks = static_cast<Index>(e.tasks.size());
  if (e.threads <= 1) {
    for (Index t = 0; t < tasks; ++t) work(t);
    return;
  }
  std::vector<std::atomic<int>> waiting(tasks);
  for (Index t = 0; t < tasks; ++t) waiting[t] = e.tasks[t].children;
  tbb::task_arena(std::min(e.threads, tbb::info::default_concurrency())).execute([&] {
    parallel::Tasks group;
    for (Index leaf = 0; leaf < tasks; ++leaf) {
      if (e.tasks[leaf].children > 0) continue;
      group.begin([&, leaf] {
        // The last child to finish goes on with its parent.
        for (Index t = leaf; t >= 0;) {
          work(t);
          t = e.tasks[t].parent;
          if (t >= 0 && --waiting[t] > 0) break;
        }
      });
    }
    group.wait();
  });
}

}  // namespace

Elimination plan_elimination(const factor::LinearSystem& system, const graph::Order& order,
                             int threads) {
  assert(factor::is_laid_out(system));
  Elimination e;
  e.tree = clique_tree(*system.pattern, order);
  e.rows = graph::grouped(e.tree.row_clique, e.tree.cliques());
  e.children = graph::grouped(e.tree.parent, e.tree.cliques());
  plan_scalars(*system.pattern, e);
  plan_leaves(e);
  plan_runs(*system.pattern, e);
  plan_tasks(e, threads);
  plan_storage(system, e);
  return e;
}

std::vector<Index> eliminate(Elimination& e, const factor::LinearSystem& system,
                             std::span<const double> damping) {
  assert(factor::is_laid_out(system) && system.pattern->dim == e.dim);
  assert(damping.empty() || damping.size() == e.floors.size());
  set_floors(system, e.floor_at, e.floors);
  const Kernels& kernel = kernels();
  std::atomic<int> dropped = 0;
  run_tasks(e, [&](Index t) {
    const int thread = e.threads <= 1 ? 0 : tbb::this_task_arena::current_thread_index();
    double* const scratch = e.scratch.data() + e.scratch_size * thread;
    int here = 0;
    for (Index c = e.tasks[t].first; c <= e.tasks[t].last; ++c)
      here += eliminate_clique(e, system, damping, c, kernel, scratch);
    dropped += here;
  });
  std::vector<Index> undetermined;
  if (dropped == 0) return undetermined;
  for (Index c = 0; c < e.tree.cliques(); ++c)
    append_vanished(e.front(c), e.tree.frontals[c], e.dim, undetermined);
  std::ranges::sort(undetermined);
  return undetermined;
}

std::optional<Elimination> eliminated(const factor::LinearSystem& system,
                                      const graph::Order& order) {
  std::optional<Elimination> result = plan_elimination(system, order);
  if (!eliminate(*result, system).empty()) result.reset();
  return result;
}

void back_substitute(Elimination& e, std::vector<double>& step) {
  const Kernels& kernel = kernels();
  step.resize(e.step_at.back());
  double* const x = e.scratch.data();
  for (Index c = e.tree.cliques() - 1; c >= 0; --c) {
    const Front front = e.front(c);
    std::fill_n(x, front.ld_l(), 0.0);
    int row = front.f;
    for (Index j : e.tree.separators[c]) {
      for (int k = 0; k < e.dim[j]; ++k) x[row++] = step[e.step_at[j] + k];
    }
    x[row] = -1;
    kernel.back_substitute(front, x);
    row = 0;
    for (Index j : e.tree.frontals[c]) {
      for (int k = 0; k < e.dim[j]; ++k) step[e.step_at[j] + k] = x[row++];
    }
  }
}

double log_determinant(Elimination& e) {
  double sum = 0;
  for (Index c = 0; c < e.tree.cliques(); ++c) {
    const Front front = e.front(c);
    for (int k = 0; k < front.f; ++k) sum += std::log(front.pivot(k));
  }
  return 2 * sum;
}

}  // namespace sg::solve
