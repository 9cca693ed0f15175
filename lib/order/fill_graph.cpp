#include "lib/order/fill_graph.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

namespace sg::order {
namespace {

bool is_outer(const FillGraph& g, Index v) {
  return v >= g.inner;
}

void note_change(FillGraph& g, Index v) {
  if (g.fill[v].changed == g.round) return;
  g.fill[v].changed = g.round;
  g.changed.push_back(v);
}

void drop_dead(FillGraph& g, Index v) {
  FillGraph::List& list = g.list[v];
  g.work += list.size;
  if (list.size == list.live) return;
  Index* const begin = g.pool.data() + list.begin;
  const char* const alive = g.variables.alive.data();
  const auto end = std::remove_if(begin, begin + list.size, [&](Index w) { return !alive[w]; });
  list.size = static_cast<Index>(end - begin);
}

void append(FillGraph& g, Index v, Index w) {
  FillGraph::List& list = g.list[v];
  if (list.size == list.capacity) {
    const auto moved = static_cast<std::int64_t>(g.pool.size());
    list.capacity = 2 * list.capacity + 4;
    g.pool.resize(g.pool.size() + list.capacity);
    std::copy_n(g.pool.begin() + list.begin, list.size, g.pool.begin() + moved);
    list.begin = moved;
  }
  g.pool[list.begin + list.size++] = w;
  ++list.live;
}

void mark_closed_neighbourhood(FillGraph& g, Index v) {
  ++g.stamp;
  g.mark[v] = g.stamp;
  for (Index w : neighbours(g, v)) g.mark[w] = g.stamp;
}

bool all_marked(FillGraph& g, Index v) {
  const std::span<const Index> entries(g.pool.data() + g.list[v].begin, g.list[v].size);
  for (Index w : entries) {
    ++g.work;
    if (g.mark[w] != g.stamp && g.variables.alive[w]) return false;
  }
  return true;
}

// Takes `pair` off the fill of the marked among the neighbours of b. Returns their weight.
// The innermost loop of all: hence the copies of what the compiler would load again and again.
std::int64_t take_off_common(FillGraph& g, Index b, std::int64_t pair) {
  const int* const mark = g.mark.data();
  FillGraph::Fill* const fill = g.fill.data();
  const int stamp = g.stamp;
  const int round = g.round;
  const Index* const begin = g.pool.data() + g.list[b].begin;
  const Index* const end = begin + g.list[b].size;
  std::int64_t common = 0;
  for (const Index* w = begin; w != end; ++w) {
    if (mark[*w] != stamp) continue;
    FillGraph::Fill& entry = fill[*w];
    entry.fill -= pair;
    common += entry.weight;
    if (entry.changed != round) note_change(g, *w);
  }
  return common;
}

// The new edge {a, b}, not both outer; the closed neighbourhood of a is marked.
void join(FillGraph& g, Index a, Index b) {
  if (g.list[b].size > 2 * g.list[b].live + 8) drop_dead(g, b);
  const std::int64_t weight_a = g.fill[a].weight;
  const std::int64_t weight_b = g.fill[b].weight;
  const std::int64_t common = take_off_common(g, b, weight_a * weight_b);
  g.work += g.list[b].size;
  // An outer vertex is joined to the outer neighbours of the other end already.
  g.fill[a].fill += weight_b * (g.degree[a] - common - (is_outer(g, b) ? g.around[a] : 0));
  g.fill[b].fill += weight_a * (g.degree[b] - common - (is_outer(g, a) ? g.around[b] : 0));
  g.degree[a] += weight_b;
  g.degree[b] += weight_a;
  if (is_outer(g, b)) g.around[a] += weight_b;
  if (is_outer(g, a)) g.around[b] += weight_a;
  g.hash[a] += mix(b);
  g.hash[b] += mix(a);
  append(g, a, b);
  append(g, b, a);
  g.mark[b] = g.stamp;
  note_change(g, a);
  note_change(g, b);
}

// Makes the neighbours of v a clique.
void join_neighbours(FillGraph& g, Index v) {
  std::vector<Index>& clique = g.clique;
  const auto largest = std::max_element(clique.begin(), clique.end(), [&](Index a, Index b) {
    return g.list[a].size < g.list[b].size;
  });
  const Index hub = *largest;
  *largest = clique.back();
  clique.back() = hub;
  const auto outer =
      std::partition(clique.begin(), clique.end() - 1, [&](Index u) { return !is_outer(g, u); });
  const auto inner = static_cast<std::size_t>(outer - clique.begin());
  std::vector<Index>& miss_hub = g.miss_hub;
  miss_hub.clear();
  const std::size_t others = clique.size() - 1;
  for (std::size_t i = 0; i < inner && g.fill[v].fill > 0; ++i) {
    mark_closed_neighbourhood(g, clique[i]);
    for (std::size_t j = i + 1; j < others; ++j) {
      if (g.mark[clique[j]] != g.stamp) join(g, clique[i], clique[j]);
    }
    if (g.mark[hub] != g.stamp) miss_hub.push_back(clique[i]);
    g.work += static_cast<std::int64_t>(others - i);
  }
  if (!is_outer(g, hub)) miss_hub.insert(miss_hub.end(), outer, clique.end() - 1);
  if (miss_hub.empty()) return;
  mark_closed_neighbourhood(g, hub);
  for (Index b : miss_hub) {
    if (g.mark[b] != g.stamp) join(g, hub, b);
  }
}

void merge(FillGraph& g, Index kept, Index gone) {
  for (Index w : neighbours(g, gone)) {
    g.hash[w] -= mix(gone);
    --g.list[w].live;
  }
  absorb(g.variables, kept, gone);
  if (!is_outer(g, kept)) g.degree[kept] -= g.fill[gone].weight;
  g.fill[kept].weight = g.variables.weight[kept];
  note_change(g, kept);
}

// Merges the indistinguishable ones among `candidates`, whose H are up to date.
void merge_indistinguishable(FillGraph& g, std::span<const Index> candidates) {
  auto& by_hash = g.by_hash;
  by_hash.clear();
  for (Index v : candidates) by_hash.emplace_back(g.hash[v] + mix(~g.stage[v]), v);
  std::sort(by_hash.begin(), by_hash.end());
  for (std::size_t i = 0, j = 0; i < by_hash.size(); i = j) {
    for (j = i + 1; j < by_hash.size() && by_hash[j].first == by_hash[i].first; ++j) {
      merge(g, by_hash[i].second, by_hash[j].second);
    }
  }
}

// Takes out v, whose neighbours are a clique.
void remove_simplicial(FillGraph& g, Index v, std::span<const Index> clique) {
  const std::int64_t weight = g.fill[v].weight;
  for (Index u : clique) {
    const std::int64_t outside = g.degree[u] + g.fill[u].weight - g.degree[v] - weight;
    g.fill[u].fill -= weight * outside;
    g.degree[u] -= weight;
    g.hash[u] -= mix(v);
    --g.list[u].live;
    note_change(g, u);
  }
  eliminate_members(g.variables, v, g.degree[v]);
}

// Edges from every live variable to its neighbours of higher (degree, index).
graph::Adjacency upward(FillGraph& g) {
  graph::Adjacency up;
  for (Index v = 0; v < static_cast<Index>(g.list.size()); ++v) {
    if (g.variables.alive[v]) {
      for (Index w : neighbours(g, v)) {
        if (std::pair(g.list[v].live, v) < std::pair(g.list[w].live, w)) up.items.push_back(w);
      }
    }
    up.close();
  }
  return up;
}

// fill(v) if no two neighbours are adjacent, but for outer ones.
void bound_fill(FillGraph& g) {
  for (Index v = 0; v < static_cast<Index>(g.list.size()); ++v) {
    if (!g.variables.alive[v]) continue;
    std::int64_t squares = 0;  // of neighbours that are not joined to any other
    for (Index w : neighbours(g, v)) {
      if (!is_outer(g, w)) squares += std::int64_t{g.fill[w].weight} * g.fill[w].weight;
    }
    g.fill[v].fill = (g.degree[v] * g.degree[v] - squares - g.around[v] * g.around[v]) / 2;
  }
}

// Every triangle takes the weight of an edge off the fill of the vertex opposite. Each is found
// once, at its lowest vertex (the "forward" algorithm: Schank, Wagner 2005).
void count_fill(FillGraph& g, std::int64_t work_limit) {
  const graph::Adjacency up = upward(g);
  std::int64_t work = 0;
  for (Index w : up.items) work += up.begin[w + 1] - up.begin[w];
  g.exact = work <= work_limit;
  if (!g.exact) return;
  g.work += work;
  for (Index v = 0; v < up.size(); ++v) {
    if (up[v].size() < 2) continue;
    ++g.stamp;
    for (Index a : up[v]) g.mark[a] = g.stamp;
    for (Index a : up[v]) {
      for (Index b : up[a]) {
        if (g.mark[b] != g.stamp) continue;
        const std::int64_t dv = g.fill[v].weight, da = g.fill[a].weight, db = g.fill[b].weight;
        g.fill[v].fill -= da * db;
        g.fill[a].fill -= dv * db;
        g.fill[b].fill -= dv * da;
      }
    }
  }
}

FillGraph made(const graph::Adjacency& graph, const std::vector<int>& dim, std::vector<int> stage,
               Index inner, std::int64_t work_limit) {
  const Index n = graph.size();
  assert(static_cast<Index>(dim.size()) == n);
  FillGraph g;
  g.variables = supervariables(dim);
  g.stage = std::move(stage);
  g.inner = inner;
  g.pool = graph.items;
  g.fill.resize(n);
  g.degree.resize(n);
  g.around.resize(n);
  g.hash.resize(n);
  g.list.resize(n);
  g.mark.assign(n, 0);
  for (Index v = 0; v < n; ++v) {
    const auto size = static_cast<Index>(graph[v].size());
    g.list[v] = {graph.begin[v], size, size, size};
    g.fill[v] = {0, dim[v], 0};
    g.hash[v] = is_outer(g, v) ? 0 : mix(v);
    for (Index w : graph[v]) {
      assert(!is_outer(g, v) || !is_outer(g, w));
      g.degree[v] += dim[w];
      if (is_outer(g, w)) g.around[v] += dim[w];
      g.hash[v] += mix(w);
    }
  }
  std::vector<Index> all(n);
  std::iota(all.begin(), all.end(), 0);
  merge_indistinguishable(g, all);
  bound_fill(g);
  count_fill(g, work_limit);
  return g;
}

}  // namespace

FillGraph fill_graph(const graph::Adjacency& graph, const std::vector<int>& dim,
                     std::vector<int> stage, std::int64_t work_limit) {
  assert(stage.empty() || static_cast<Index>(stage.size()) == graph.size());
  stage.resize(graph.size(), 0);
  return made(graph, dim, std::move(stage), graph.size(), work_limit);
}

FillGraph fill_graph_of_part(const graph::Adjacency& graph, const std::vector<int>& dim,
                             Index inner, std::int64_t work_limit) {
  std::vector<int> stage(graph.size(), 1);
  std::fill_n(stage.begin(), inner, 0);
  return made(graph, dim, std::move(stage), inner, work_limit);
}

void eliminate(FillGraph& g, Index v) {
  assert(g.exact && g.variables.alive[v]);
  const std::span<const Index> around = neighbours(g, v);
  std::vector<Index>& clique = g.clique;
  clique.assign(around.begin(), around.end());
  ++g.round;
  g.changed.clear();
  if (g.fill[v].fill > 0) join_neighbours(g, v);
  remove_simplicial(g, v, clique);
  merge_indistinguishable(g, clique);
}

double least_work(const FillGraph& g, Index v) {
  if (g.fill[v].fill == 0 || !g.variables.alive[v]) return 0;
  const auto neighbours = static_cast<double>(g.list[v].live);
  const double mean_weight = static_cast<double>(g.degree[v]) / neighbours;
  return static_cast<double>(g.fill[v].fill) / (mean_weight * mean_weight) * neighbours;
}

Index better_first(FillGraph& g, Index v) {
  mark_closed_neighbourhood(g, v);
  const std::int64_t front_v = g.fill[v].weight + g.degree[v];
  for (Index i : neighbours(g, v)) {
    const std::int64_t front_i = g.fill[i].weight + g.degree[i];
    if (front_i > front_v || g.stage[i] != g.stage[v]) continue;
    const elim::Wide i_first = elim::elimination_cost(g.fill[i].weight, front_i) +
                               elim::elimination_cost(g.fill[v].weight, front_v - g.fill[i].weight);
    const elim::Wide v_first = elim::elimination_cost(g.fill[v].weight, front_v) +
                               elim::elimination_cost(g.fill[i].weight, front_v - g.fill[v].weight);
    if (i_first < v_first && all_marked(g, i)) return i;
  }
  return v;
}

std::span<const Index> neighbours(FillGraph& g, Index v) {
  drop_dead(g, v);
  return {g.pool.data() + g.list[v].begin, static_cast<std::size_t>(g.list[v].size)};
}

}  // namespace sg::order
