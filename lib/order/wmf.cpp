#include "lib/order/wmf.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "lib/order/amd.h"
#include "lib/order/dissect.h"
#include "lib/order/fill_graph.h"
#include "lib/order/methods.h"
#include "lib/order/min_queue.h"
#include "lib/order/quotient_graph.h"

namespace sg::order {
namespace {

// List entries looked at for every entry of the graph, up to which a pass is quick.
constexpr std::int64_t quick_work = 25;

std::int64_t fill(const FillGraph& g, Index v) {
  return g.fill[v].fill;
}
std::int64_t fill(const QuotientGraph& g, Index v) {
  return g.fill[v];
}
Index better_first(const QuotientGraph&, Index v) {
  return v;
}  // mass elimination does it

// How a pass ranks variables.
struct Preference {
  FillScore score;
  std::vector<Index> rank;     // of variables with equal score
  std::vector<double> factor;  // empty: 1
};

double uniform(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

Preference preferences(Index n, const GreedyOptions& options) {
  Preference result{options.score, std::vector<Index>(n), {}};
  std::iota(result.rank.begin(), result.rank.end(), 0);
  if (options.seed != 0) {
    const std::uint64_t start = mix(options.seed);
    std::vector<Index> drawn = result.rank;
    std::sort(drawn.begin(), drawn.end(),
              [&](Index a, Index b) { return mix(start + a) < mix(start + b); });
    for (Index k = 0; k < n; ++k) result.rank[drawn[k]] = k;
  }
  if (options.jitter > 0) {
    const std::uint64_t start = mix(~options.seed);
    for (Index v = 0; v < n; ++v) {
      result.factor.push_back(1 + options.jitter * uniform(mix(start + v)));
    }
  }
  return result;
}

// Squared where that saves a root: only the order of scores counts.
template <class Graph>
double key(const Graph& g, const Preference& preference, Index v) {
  const double factor = preference.factor.empty() ? 1 : preference.factor[v];
  const double score = static_cast<double>(fill(g, v)) * factor;
  if (preference.score == FillScore::plain) return score;
  const auto frontal = static_cast<double>(g.variables.weight[v]);
  return score * score / (frontal * (frontal + static_cast<double>(g.degree[v])));
}

// The variables by ascending stage.
std::vector<Index> by_stage(const std::vector<int>& stage) {
  std::vector<Index> sorted(stage.size());
  std::iota(sorted.begin(), sorted.end(), 0);
  if (std::is_sorted(stage.begin(), stage.end())) return sorted;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](Index a, Index b) { return stage[a] < stage[b]; });
  return sorted;
}

// Eliminates the best variable, again and again, until none is left or `enough` of the next
// says so.
template <class Graph, class Predicate>
void run(Graph& g, const Preference& preference, Predicate enough) {
  const std::vector<Index> sorted = by_stage(g.stage);
  MinQueue queue(static_cast<Index>(sorted.size()));
  queue.rank = preference.rank;
  for (auto at = sorted.begin(); at != sorted.end();) {
    const int stage = g.stage[*at];
    for (; at != sorted.end() && g.stage[*at] == stage; ++at) {
      if (g.variables.alive[*at]) set_key(queue, *at, key(g, preference, *at));
    }
    while (!queue.empty()) {
      if (enough(queue.heap.front())) return;
      const Index v = pop(queue);
      if (!g.variables.alive[v]) continue;  // merged since
      const Index first = better_first(g, v);
      if (first != v) {
        set_key(queue, v, key(g, preference, v));
        erase(queue, first);
      }
      eliminate(g, first);
      for (Index u : g.changed) {
        if (g.variables.alive[u] && g.stage[u] == stage) set_key(queue, u, key(g, preference, u));
      }
    }
  }
}

// Eliminates the rest of g by bounds. Its ec is one from above: mass elimination puts variables
// before their pivot whose own fronts it does not know.
Supervariables run_by_bounds(FillGraph&& g, const Preference& preference,
                             const GreedyOptions& options) {
  QuotientGraph rest = quotient_graph(std::move(g));
  run(rest, preference,
      [&](Index) { return rest.variables.ec > options.limit || rest.work > options.bounded_work; });
  return std::move(rest.variables);
}

std::vector<int> stages(Index n, const std::vector<Index>& last) {
  std::vector<int> stage(n, 0);
  for (Index j : last) stage.at(j) = 1;
  return stage;
}

std::int64_t entries(const graph::Adjacency& graph) {
  return static_cast<std::int64_t>(graph.items.size()) + graph.size();
}

void keep_better(GreedyResult& best, GreedyResult&& other) {
  if (!other.order.empty() && other.ec < best.ec) best = std::move(other);
}

// Where the first pass was quick.
void try_plain_fill(const graph::Pattern& pattern, const graph::Adjacency& graph,
                    GreedyOptions greedy, GreedyResult& best) {
  greedy.score = FillScore::plain;
  greedy.limit = best.ec;
  keep_better(best, greedy_fill(pattern, graph, greedy));
}

// Where the graph is dense: bounds alone, which take a clique at a time.
void try_bounds(const graph::Pattern& pattern, const graph::Adjacency& graph, GreedyOptions greedy,
                GreedyResult& best) {
  greedy.exact_work = 0;
  greedy.limit = best.ec;
  keep_better(best, greedy_fill(pattern, graph, greedy));
}

}  // namespace

GreedyResult greedy_fill(const graph::Pattern& pattern, const graph::Adjacency& graph,
                         const GreedyOptions& options) {
  assert(graph.size() == pattern.variables());
  const std::int64_t work_limit = options.exact_work * entries(graph);
  const Preference preference = preferences(graph.size(), options);
  FillGraph g = fill_graph(graph, pattern.dim, options.stage, work_limit);
  if (g.exact) {
    run(g, preference, [&](Index next) {
      return static_cast<double>(g.work) + least_work(g, next) > static_cast<double>(work_limit) ||
             g.variables.ec > options.limit;
    });
  }
  GreedyResult result{{}, g.variables.ec, g.work};
  if (result.ec > options.limit) return result;
  if (g.variables.order.size() == pattern.dim.size()) {
    result.order = std::move(g.variables.order);
    return result;
  }
  Supervariables variables = run_by_bounds(std::move(g), preference, options);
  result.ec = variables.ec;
  if (result.ec > options.limit || variables.order.size() < pattern.dim.size()) return result;
  result.order = std::move(variables.order);
  result.ec = elim::elimination_complexity(pattern, result.order);
  return result;
}

namespace {

// Exact EC of a part's order. What is around it is a clique as good as any: it comes last.
elim::Wide ec_of_part(const graph::Adjacency& graph, const std::vector<int>& dim,
                      const graph::Order& order) {
  graph::Pattern pattern{dim, {}};
  for (Index v = 0; v < graph.size(); ++v) {
    for (const Index u : graph[v]) {
      if (u > v) pattern.rows.add(std::array{v, u});
    }
  }
  graph::Order all = order;
  for (auto v = static_cast<Index>(order.size()); v < graph.size(); ++v) all.push_back(v);
  const elim::Symbolic symbolic = elim::symbolic(pattern, all);
  elim::Wide ec = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    ec += elim::elimination_cost(symbolic.dim[k], symbolic.count[k]);
  }
  return ec;
}

}  // namespace

GreedyResult greedy_fill_of_part(const graph::Adjacency& graph, const std::vector<int>& dim,
                                 Index inner, elim::Wide limit) {
  const std::int64_t work_limit = GreedyOptions{}.exact_work * entries(graph);
  const Preference preference = preferences(graph.size(), {});
  FillGraph g = fill_graph_of_part(graph, dim, inner, work_limit);
  const auto all_done = [&](Index next) { return next >= inner; };
  if (g.exact) {
    run(g, preference, [&](Index next) {
      return all_done(next) || g.variables.ec > limit ||
             static_cast<double>(g.work) + least_work(g, next) > static_cast<double>(work_limit);
    });
  }
  GreedyResult result{{}, g.variables.ec, g.work};
  if (result.ec > limit) return result;
  if (static_cast<Index>(g.variables.order.size()) == inner) {
    result.order = std::move(g.variables.order);
    return result;
  }
  QuotientGraph rest = quotient_graph(std::move(g));
  run(rest, preference, all_done);
  result.order = std::move(rest.variables.order);
  result.ec = ec_of_part(graph, dim, result.order);
  return result;
}

namespace {

// EC a list entry of the graph: up to the one, dissection is not worth a try; beyond the other, minimum fill is not on a
// graph of more than so many entries.
constexpr std::int64_t narrow = 1000, wide = 2000, medium = 15'000;
// Variables of a graph that dissection would leave to minimum fill at once, about.
constexpr Index small = 400;
// Entries a variable, beyond which a graph is no mesh.
constexpr std::int64_t dense = 20;
// List entries that a pass may look at for every entry of a large graph.
constexpr std::int64_t most_work = 20;

// The better of the greedy passes that the graph affords, and of amd, which wins on some small graphs.
GreedyResult minimum_fill(const graph::Pattern& pattern, const graph::Adjacency& graph,
                          const GreedyOptions& greedy, GreedyResult&& amd) {
  GreedyResult best = greedy_fill(pattern, graph, greedy);
  const std::int64_t size = entries(graph);
  const bool given_up = best.order.empty();
  const bool quick = !given_up && best.work <= quick_work * size;
  const bool many = size > dense * std::int64_t{graph.size()};
  if (given_up || amd.ec < best.ec) best = {std::move(amd.order), amd.ec, best.work};
  if (quick) {
    try_plain_fill(pattern, graph, greedy, best);
  } else if (!given_up && many && best.work <= 100 * size) {
    try_bounds(pattern, graph, greedy, best);
  }
  return best;
}

GreedyResult by_dissection(const graph::Pattern& pattern, const graph::Adjacency& graph,
                           std::uint64_t seed) {
  GreedyResult result{dissect(graph, pattern.dim, seed), 0, 0};
  result.ec = elim::elimination_complexity(pattern, result.order);
  return result;
}

}  // namespace

bool is_wide(const graph::Adjacency& graph, elim::Wide ec) {
  return ec > elim::Wide{narrow} * static_cast<elim::Wide>(entries(graph));
}

namespace {

// Passes and pieces take and leave memory all the time. The C library gives it back to the system, at many times the
// price of a pass over a small graph, until it has seen as much as this come and go at once (mallopt(3), dynamic threshold).
void keep_memory_between_passes(const graph::Adjacency& graph) {
  constexpr std::int64_t bytes_an_entry = 200, least = 1 << 20, most = 30 << 20;
  const std::int64_t bytes = std::clamp(bytes_an_entry * entries(graph), least, most);
  void* volatile once = std::malloc(static_cast<std::size_t>(bytes));
  std::free(once);
}

}  // namespace

graph::Order wmf(const graph::Pattern& pattern, const WmfOptions& options) {
  const graph::Adjacency graph = graph::adjacency(pattern);
  keep_memory_between_passes(graph);
  GreedyOptions greedy;
  greedy.seed = options.seed;
  if (!options.last.empty()) {
    greedy.stage = stages(pattern.variables(), options.last);
    return greedy_fill(pattern, graph, greedy).order;
  }
  GreedyResult amd{minimum_degree(graph), 0, 0};
  amd.ec = elim::elimination_complexity(pattern, amd.order);
  const elim::Wide by_amd = amd.ec;
  const std::int64_t size = entries(graph);
  // Hubs are in every front, and have long lists.
  if (size > medium) greedy.bounded_work = most_work * size;
  // Where variables have many neighbours, landmarks do, a high EC says nothing of width.
  const bool sparse = size <= dense * std::int64_t{graph.size()};
  if (sparse && size > medium && is_wide(graph, by_amd)) {
    GreedyResult best = by_dissection(pattern, graph, options.seed);
    if (best.ec <= elim::Wide{wide} * static_cast<elim::Wide>(size)) {
      greedy.limit = best.ec;
      keep_better(best, minimum_fill(pattern, graph, greedy, std::move(amd)));
    }
    return std::move(best.order);
  }
  GreedyResult best = minimum_fill(pattern, graph, greedy, std::move(amd));
  const bool given_up = size > medium && best.ec == by_amd;
  if (sparse && graph.size() > small && is_wide(graph, best.ec) && (size <= medium || given_up)) {
    keep_better(best, by_dissection(pattern, graph, options.seed));
  }
  return std::move(best.order);
}

namespace methods {

graph::Order wmf(const graph::Pattern& pattern, const OrderOptions& options) {
  return order::wmf(pattern, {options.last, options.seed});
}

}  // namespace methods
}  // namespace sg::order
