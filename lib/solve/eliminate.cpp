#include "lib/solve/eliminate.h"

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "lib/graph/lists.h"

namespace sg {
namespace {

// Appends a run, or lengthens the last one of `first..` where it goes on.
void append(std::vector<Run>& runs, std::size_t first, Run run) {
  if (runs.size() > first) {
    Run& last = runs.back();
    if (last.from + last.length == run.from && last.to + last.length == run.to) {
      last.length += run.length;
      return;
    }
  }
  runs.push_back(run);
}

// The runs of a factor's Gram matrix; row_at: of every variable in the front its first row there.
void append_row_runs(const Pattern& pattern, Index r, const std::vector<int>& row_at, int last_row,
                     std::vector<Run>& runs) {
  const auto first = static_cast<std::ptrdiff_t>(runs.size());
  int from = 0;
  for (Index j : pattern.rows[r]) {
    runs.push_back({from, row_at[j], pattern.dim[j]});
    from += pattern.dim[j];
  }
  std::sort(runs.begin() + first, runs.end(),
            [](const Run& a, const Run& b) { return a.to < b.to; });
  runs.push_back({from, last_row, 1});
}

// The runs of the update that clique c passes to the front whose rows are row_at.
void append_child_runs(const Pattern& pattern, const CliqueTree& tree, Index c,
                       const std::vector<int>& row_at, int last_row, std::vector<Run>& runs) {
  const std::size_t first = runs.size();
  int from = 0;
  for (Index j : tree.separators_of(c)) {
    append(runs, first, {from, row_at[j], pattern.dim[j]});
    from += pattern.dim[j];
  }
  append(runs, first, {from, last_row, 1});
}

// Where rows and children go in their clique's front.
void plan_runs(const Pattern& pattern, Elimination& e) {
  const CliqueTree& tree = e.tree;
  Lists<> rows = grouped(tree.row_clique, tree.cliques());
  e.rows_begin = std::move(rows.begin);
  e.rows = std::move(rows.items);
  Lists<> children = grouped(tree.parent, tree.cliques());
  e.children_begin = std::move(children.begin);
  e.children = std::move(children.items);
  std::vector<int> row_at(pattern.variables());
  for (Index c = 0; c < tree.cliques(); ++c) {
    int row = 0;
    for (const auto& variables : {tree.frontals_of(c), tree.separators_of(c)}) {
      for (Index j : variables) {
        row_at[j] = row;
        row += pattern.dim[j];
      }
    }
    for (Index i = e.rows_begin[c]; i < e.rows_begin[c + 1]; ++i) {
      append_row_runs(pattern, e.rows[i], row_at, row, e.row_runs.runs);
      e.row_runs.begin.push_back(static_cast<Index>(e.row_runs.runs.size()));
    }
    for (Index i = e.children_begin[c]; i < e.children_begin[c + 1]; ++i) {
      append_child_runs(pattern, tree, e.children[i], row_at, row, e.child_runs.runs);
      e.child_runs.begin.push_back(static_cast<Index>(e.child_runs.runs.size()));
    }
  }
}

void plan_scalars(const Pattern& pattern, Elimination& e) {
  e.dim = pattern.dim;
  e.step_at.assign(1, 0);
  for (int dim : pattern.dim) e.step_at.push_back(e.step_at.back() + dim);
  e.floor_at.resize(pattern.variables());
  Index scalar = 0;
  for (Index j : e.tree.frontals) {
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

// Places the updates of a task's cliques from `base` on; returns where they end.
Offset plan_updates(Elimination& e, const Elimination::Task& task, const std::vector<int>& depth,
                    Offset base) {
  Offset top[2] = {0, 0};
  Offset peak[2] = {0, 0};
  for (Index c = task.first; c <= task.last; ++c) {
    const int side = depth[c] % 2;
    e.u_at[c] = top[side];
    top[side] += e.front(c).size_u();
    peak[side] = std::max(peak[side], top[side]);
    for (Index i = e.children_begin[c]; i < e.children_begin[c + 1]; ++i) {
      const Index child = e.children[i];
      if (child >= task.first) top[1 - side] = std::min(top[1 - side], e.u_at[child]);
    }
  }
  for (Index c = task.first; c <= task.last; ++c)
    e.u_at[c] += base + (depth[c] % 2 == 0 ? 0 : peak[0]);
  return base + peak[0] + peak[1];
}

void plan_storage(const LinearSystem& system, Elimination& e) {
  const Index cliques = e.tree.cliques();
  e.l_at.resize(cliques);
  e.u_at.resize(cliques);
  Offset l = 0;
  int rows = 0;
  std::vector<int> depth(cliques, 0);
  for (Index c = cliques - 1; c >= 0; --c) {
    if (e.tree.parent[c] >= 0) depth[c] = depth[e.tree.parent[c]] + 1;
  }
  for (Index c = 0; c < cliques; ++c) {
    const Front front = e.front(c);
    e.l_at[c] = l;
    l += front.size_l();
    rows = std::max(rows, front.ld_l());
  }
  Offset u = 0;
  for (const Elimination::Task& task : e.tasks) u = plan_updates(e, task, depth, u);
  e.conditionals = Arena(l + lane);
  e.updates = Arena(u + lane);

  e.scratch_size = rows + lane;
  for (Index r = 0; r < system.pattern->rows.size(); ++r) {
    const std::size_t height = system.height[r];
    const std::size_t width =
        height == 0 ? 0 : (system.begin[r + 1] - system.begin[r]) / static_cast<Offset>(height);
    e.scratch_size = std::max(e.scratch_size, width * width + lane + height * (width + lane));
  }
  e.scratch_size = round_up(static_cast<int>(e.scratch_size));
  e.scratch = Arena(e.scratch_size * std::max<std::size_t>(e.tasks.size(), 1));
}

// The least that a pivot must be, from the largest diagonal entry that a factor gives a scalar.
void set_floors(const LinearSystem& system, Elimination& e) {
  std::fill(e.floors.begin(), e.floors.end(), 0.0);
  for (Index r = 0; r < system.pattern->rows.size(); ++r) {
    const double* column = system.block(r);
    for (Index j : system.pattern->rows[r]) {
      for (int k = 0; k < e.dim[j]; ++k) {
        double square = 0;
        for (int i = 0; i < system.height[r]; ++i) square += column[i] * column[i];
        column += system.height[r];
        double& floor = e.floors[e.floor_at[j] + k];
        floor = std::max(floor, vanishing * square);
      }
    }
  }
}

void damp(const Elimination& e, Index c, std::span<const double> damping, const Front& front) {
  int row = 0;
  for (Index j : e.tree.frontals_of(c)) {
    for (int k = 0; k < e.dim[j]; ++k, ++row)
      front.l[row * (front.ld_l() + 1)] += damping[e.step_at[j] + k];
  }
}

// Gathers and eliminates one clique; returns how many of its pivots vanished.
int eliminate_clique(Elimination& e, const LinearSystem& system, std::span<const double> damping,
                     Index c, const Kernels& kernel, double* scratch) {
  const Front front = e.front(c);
  kernel.clear(front);
  for (Index i = e.rows_begin[c]; i < e.rows_begin[c + 1]; ++i) {
    const Index r = e.rows[i];
    const Run* const runs = e.row_runs.data(i);
    const int count = e.row_runs.count(i);
    const int width = runs[count - 1].from + 1;
    kernel.gram(system.block(r), system.height[r], width, scratch, scratch + width * width + lane);
    kernel.add(front, scratch, width, runs, count);
  }
  if (!damping.empty()) damp(e, c, damping, front);
  for (Index i = e.children_begin[c]; i < e.children_begin[c + 1]; ++i) {
    const Front child = e.front(e.children[i]);
    kernel.add(front, child.u, child.ld_u(), e.child_runs.data(i), e.child_runs.count(i));
  }
  return kernel.factorize(front, e.floors.data() + e.floor_at[e.tree.frontals_of(c).front()]);
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
    tbb::task_group group;
    for (Index leaf = 0; leaf < tasks; ++leaf) {
      if (e.tasks[leaf].children > 0) continue;
      group.run([&, leaf] {
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

std::vector<Index> vanished(Elimination& e) {
  std::vector<Index> variables;
  for (Index c = 0; c < e.tree.cliques(); ++c) {
    const Front front = e.front(c);
    int row = 0;
    for (Index j : e.tree.frontals_of(c)) {
      bool dropped = false;
      for (int k = 0; k < e.dim[j]; ++k, ++row) dropped |= front.l[row * (front.ld_l() + 1)] == 0;
      if (dropped) variables.push_back(j);
    }
  }
  std::sort(variables.begin(), variables.end());
  return variables;
}

}  // namespace

Elimination plan_elimination(const LinearSystem& system, const Order& order, int threads) {
  Elimination e;
  e.tree = clique_tree(*system.pattern, order);
  plan_scalars(*system.pattern, e);
  plan_runs(*system.pattern, e);
  plan_tasks(e, threads);
  plan_storage(system, e);
  return e;
}

std::vector<Index> eliminate(Elimination& e, const LinearSystem& system,
                             std::span<const double> damping) {
  set_floors(system, e);
  const Kernels& kernel = kernels();
  std::atomic<int> dropped = 0;
  run_tasks(e, [&](Index t) {
    double* const scratch = e.scratch.data() + e.scratch_size * t;
    int here = 0;
    for (Index c = e.tasks[t].first; c <= e.tasks[t].last; ++c)
      here += eliminate_clique(e, system, damping, c, kernel, scratch);
    dropped += here;
  });
  return dropped == 0 ? std::vector<Index>{} : vanished(e);
}

void back_substitute(Elimination& e, std::vector<double>& step) {
  const Kernels& kernel = kernels();
  step.resize(e.step_at.back());
  double* const x = e.scratch.data();
  for (Index c = e.tree.cliques() - 1; c >= 0; --c) {
    const Front front = e.front(c);
    std::fill_n(x, front.ld_l(), 0.0);
    int row = front.f;
    for (Index j : e.tree.separators_of(c)) {
      for (int k = 0; k < e.dim[j]; ++k) x[row++] = step[e.step_at[j] + k];
    }
    x[row] = -1;
    kernel.back_substitute(front, x);
    row = 0;
    for (Index j : e.tree.frontals_of(c)) {
      for (int k = 0; k < e.dim[j]; ++k) step[e.step_at[j] + k] = x[row++];
    }
  }
}

double log_determinant(Elimination& e) {
  double sum = 0;
  for (Index c = 0; c < e.tree.cliques(); ++c) {
    const Front front = e.front(c);
    for (int k = 0; k < front.f; ++k) sum += std::log(front.l[k * (front.ld_l() + 1)]);
  }
  return 2 * sum;
}

}  // namespace sg
