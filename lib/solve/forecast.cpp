#include "lib/solve/forecast.h"

#include <algorithm>
#include <cmath>

#include "lib/elim/bayes_tree.h"
#include "lib/elim/counts.h"
#include "lib/solve/assembly.h"
#include "lib/solve/clique_tree.h"
#include "lib/solve/factorize.h"
#include "lib/solve/update_stacks.h"

namespace sg::solve {
namespace {

template <class T>
std::int64_t bytes(const std::vector<T>& list) {
  return static_cast<std::int64_t>(list.size() * sizeof(T));
}

template <class T>
std::int64_t bytes(const graph::Lists<T>& lists) {
  return bytes(lists.begin) + bytes(lists.items);
}

std::int64_t bytes(const Arena& arena) {
  return static_cast<std::int64_t>(arena.size() * sizeof(double));
}

// Variables in all cliques' separators, and in each clique's.
struct Separators {
  std::int64_t all = 0;
  std::vector<Index> of;
};

Separators count_separators(const elim::Links& links, const std::vector<Index>& parent,
                            const elim::BayesTree& tree, const CliqueOutline& outline) {
  const std::vector<int> ones(parent.size(), 1);
  const std::vector<std::int64_t> count = elim::column_counts(links, ones, parent);
  Separators result;
  result.of.assign(outline.tree.cliques(), 0);
  for (Index c = 0; c < tree.cliques(); ++c) {
    if (outline.target[c] != c) continue;
    const std::int64_t variables = count[tree.top[c]] - 1;
    result.of[outline.clique[c]] = static_cast<Index>(variables);
    result.all += variables;
  }
  return result;
}

// clique_outline wants children before parents.
CliqueOutline outline_of(const elim::BayesTree& tree) {
  const Index last = tree.cliques() - 1;
  std::vector<Index> parent;
  std::vector<int> frontal, separator;
  for (Index c = last; c >= 0; --c) {
    parent.push_back(tree.parent[c] < 0 ? -1 : last - tree.parent[c]);
    frontal.push_back(static_cast<int>(tree.frontal_dim[c]));
    separator.push_back(static_cast<int>(tree.total_dim[c] - tree.frontal_dim[c]));
  }
  CliqueOutline result = clique_outline(parent, frontal, separator);
  std::ranges::reverse(result.clique);
  std::ranges::reverse(result.target);
  for (Index& c : result.target) c = last - c;
  return result;
}

// Of an elimination to come.
struct Plan {
  elim::BayesTree bayes;
  CliqueOutline outline;
  Separators separators;
  graph::Lists<> children;
  std::vector<Offset> update_at;  // -1 where none is formed

  Index cliques() const { return outline.tree.cliques(); }
  Front front(Index c) const {
    const int f = outline.tree.frontal_dim[c];
    return {nullptr, nullptr, f, f + outline.tree.separator_dim[c] + 1};
  }
};

Plan plan(const graph::Pattern& pattern, const graph::Order& order,
          const elim::Symbolic& symbolic) {
  Plan result{elim::bayes_tree(symbolic), {}, {}, {}, {}};
  result.outline = outline_of(result.bayes);
  result.separators =
      count_separators(elim::links(pattern, order), symbolic.parent, result.bayes, result.outline);
  result.children = graph::grouped(result.outline.tree.parent, result.cliques());
  result.update_at.assign(result.cliques(), 0);
  for (Index c = 0; c < result.cliques(); ++c) {
    const Front front = result.front(c);
    if (result.children[c].empty() && stays_factor(front.f, front.s())) result.update_at[c] = -1;
  }
  return result;
}

// As factor_bytes and peak_bytes count them.
void count_bytes(const graph::Pattern& pattern, Plan& plan, Forecast& result) {
  const CliqueTree& tree = plan.outline.tree;
  const std::int64_t cliques = plan.cliques(), n = pattern.variables();
  std::int64_t numbers = lane;
  for (Index c = 0; c < cliques; ++c) numbers += plan.front(c).size_l();
  const std::int64_t lists = 2 * (cliques + 1) + n + plan.separators.all;
  result.factor_bytes =
      numbers * std::int64_t{sizeof(double)} + (lists + n + 1) * std::int64_t{sizeof(Index)} +
      (2 * cliques + n) * std::int64_t{sizeof(int)} + cliques * std::int64_t{sizeof(Offset)};
  const Offset stack = place_updates(
      0, plan.cliques() - 1, plan.children, depths(tree.parent), 0,
      [&](Index c) { return plan.front(c).size_u(); }, plan.update_at);
  result.peak_bytes = result.factor_bytes + (stack + lane) * std::int64_t{sizeof(double)};
}

// The place of a kind in an array of them.
consteval std::size_t kind(std::string_view name) {
  std::size_t k = 0;
  while (kinds[k].name != name) ++k;
  return k;
}

void count_front(const Plan& plan, Index c, Work& work) {
  const Front front = plan.front(c);
  const double f = front.f, n = front.n, s = front.s();
  work[kind("front")] += 1;
  work[kind("pivot")] += f;
  work[kind("factor")] += f * n;
  if (plan.update_at[c] < 0) {
    work[kind("outer")] += f * s * s;
    return;
  }
  const double variables = plan.separators.of[c];
  work[kind("update")] += (n - f) * (n - f);
  work[kind("block")] += variables * variables;
  work[is_large(front.f, front.n) ? kind("panel") : kind("product")] +=
      f * (n * n - f * n + f * f / 3);
}

// A row is assembled where its first variable is eliminated; of a leaf without an update, by its parent as well.
void count_rows(const graph::Pattern& pattern, const graph::Order& order, const Plan& plan,
                Work& work) {
  const std::vector<Index> position = elim::positions(order, pattern.variables());
  for (Index r = 0; r < pattern.rows.size(); ++r) {
    double width = 1;
    int largest = 0;
    Index first = -1;
    for (const Index j : pattern.rows[r]) {
      width += pattern.dim[j];
      largest = std::max(largest, pattern.dim[j]);
      if (first < 0 || position[j] < first) first = position[j];
    }
    if (first < 0) continue;
    const Index clique = plan.outline.clique[plan.bayes.clique[first]];
    const double times = plan.update_at[clique] < 0 ? 2 : 1;
    work[kind("row")] += times;
    work[kind("gram")] += times * width * width * largest;
  }
}

}  // namespace

std::int64_t factor_bytes(const Elimination& e) {
  return bytes(e.conditionals) + bytes(e.tree.frontals) + bytes(e.tree.separators) +
         bytes(e.tree.frontal_dim) + bytes(e.tree.separator_dim) + bytes(e.l_at) + bytes(e.dim) +
         bytes(e.step_at);
}

std::int64_t peak_bytes(const Elimination& e) {
  return factor_bytes(e) + bytes(e.updates);
}

Forecast forecast(const graph::Pattern& pattern, const graph::Order& order,
                  const elim::Symbolic& symbolic) {
  Plan elimination = plan(pattern, order, symbolic);
  Forecast result;
  count_bytes(pattern, elimination, result);
  for (Index c = 0; c < elimination.cliques(); ++c) count_front(elimination, c, result.work);
  count_rows(pattern, order, elimination, result.work);
  return result;
}

Forecast forecast(const graph::Pattern& pattern, const graph::Order& order) {
  return forecast(pattern, order, elim::symbolic(pattern, order));
}

double seconds(const Work& work, const Times& times) {
  double sum = 0;
  for (std::size_t k = 0; k < kinds.size(); ++k) sum += work[k] * times[k];
  return 1e-9 * sum;
}

Times fit_times(std::span<const Sample> samples) {
  // Least squares of A t = 1 over t >= 0, by one time after the other; rows and columns of A are scaled, so that a
  // sample's seconds and a kind's largest share are 1.
  constexpr int sweeps = 20000;
  std::vector<Work> rows;
  Work scale{};
  for (const Sample& sample : samples) {
    Work& row = rows.emplace_back(sample.work);
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      row[k] *= 1e-9 / sample.seconds;
      scale[k] = std::max(scale[k], row[k]);
    }
  }
  std::array<Work, kinds.size()> gram{};
  Work right{};
  Times times{};
  for (const Work& row : rows) {
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      if (scale[i] == 0) continue;
      right[i] += row[i] / scale[i];
      for (std::size_t k = 0; k < kinds.size(); ++k) {
        if (scale[k] > 0) gram[i][k] += row[i] / scale[i] * row[k] / scale[k];
      }
    }
  }
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      if (gram[i][i] == 0) continue;
      double rest = right[i];
      for (std::size_t k = 0; k < kinds.size(); ++k) rest -= gram[i][k] * times[k];
      times[i] = std::max(0.0, times[i] + rest / gram[i][i]);
    }
  }
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    if (scale[k] > 0) times[k] /= scale[k];
  }
  return times;
}

}  // namespace sg::solve
