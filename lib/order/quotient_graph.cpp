#include "lib/order/quotient_graph.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace sg::order {
namespace {

void free_list(std::vector<Index>& list) {
  std::vector<Index>().swap(list);
}

// L_p, marked; the elements of p are absorbed.
std::vector<Index> new_element(QuotientGraph& g, Index p) {
  ++g.stamp;
  g.mark[p] = g.stamp;
  std::vector<Index> front;
  const auto take = [&](const std::vector<Index>& from) {
    for (Index i : from) {
      if (!g.variables.alive[i] || g.mark[i] == g.stamp) continue;
      g.mark[i] = g.stamp;
      front.push_back(i);
    }
  };
  take(g.edges[p]);
  for (Index e : g.elements[p]) {
    if (!g.is_element[e]) continue;
    take(g.members[e]);
    g.is_element[e] = false;
    free_list(g.members[e]);
  }
  free_list(g.edges[p]);
  free_list(g.elements[p]);
  return front;
}

std::int64_t weight(const QuotientGraph& g, const std::vector<Index>& variables) {
  std::int64_t sum = 0;
  for (Index i : variables) sum += g.variables.weight[i];
  return sum;
}

// outside[e] of every element that shares a variable with the front.
void count_outside(QuotientGraph& g, const std::vector<Index>& front) {
  for (Index i : front) {
    g.work += static_cast<std::int64_t>(g.edges[i].size() + g.elements[i].size());
    for (Index e : g.elements[i]) {
      if (!g.is_element[e]) continue;
      if (g.counted[e] != g.stamp) g.outside[e] = g.size[e];
      g.counted[e] = g.stamp;
      g.outside[e] -= g.variables.weight[i];
    }
  }
}

// Drops from A_i what the front covers, and from E_i what is absorbed, the elements within the
// front among them.
void prune(QuotientGraph& g, Index i) {
  std::erase_if(g.edges[i], [&](Index j) { return !g.variables.alive[j] || g.mark[j] == g.stamp; });
  std::erase_if(g.elements[i], [&](Index e) {
    if (g.is_element[e] && g.outside[e] == 0) {
      g.is_element[e] = false;
      free_list(g.members[e]);
    }
    return !g.is_element[e];
  });
}

// The bounds of the header. front: d(L_p); E_i does not hold p yet.
void bound_degree_and_fill(QuotientGraph& g, Index i, std::int64_t front) {
  const std::int64_t own = g.variables.weight[i];
  const std::int64_t c = front - own;
  std::int64_t t = c;
  std::int64_t squares = c * c;
  std::int64_t joined = 0;
  for (Index e : g.elements[i]) {
    const std::int64_t outside = g.outside[e];
    t += outside;
    squares += outside * outside;
    joined += outside * (g.size[e] - outside - own);
  }
  for (Index a : g.edges[i]) {
    const std::int64_t outside = g.variables.weight[a];
    t += outside;
    squares += outside * outside;
  }
  g.degree[i] = std::min(t, g.degree[i] + c);
  const std::int64_t by_parts = (t * t - squares) / 2 - joined;
  const std::int64_t by_degree = (g.degree[i] * g.degree[i] - c * c) / 2;
  g.fill[i] = std::max<std::int64_t>(0, std::min(by_parts, by_degree));
}

std::uint64_t hash(const QuotientGraph& g, Index i) {
  std::uint64_t sum = mix(~g.stage[i]);
  for (Index j : g.edges[i]) sum += mix(j);
  for (Index e : g.elements[i]) sum += mix(e);
  return sum;
}

void merge_indistinguishable(QuotientGraph& g, std::vector<Index>& front) {
  std::vector<std::pair<std::uint64_t, Index>> by_hash;
  by_hash.reserve(front.size());
  for (Index i : front) by_hash.emplace_back(hash(g, i), i);
  std::sort(by_hash.begin(), by_hash.end());
  for (std::size_t i = 0, j = 0; i < by_hash.size(); i = j) {
    const Index kept = by_hash[i].second;
    for (j = i + 1; j < by_hash.size() && by_hash[j].first == by_hash[i].first; ++j) {
      const Index gone = by_hash[j].second;
      absorb(g.variables, kept, gone);
      free_list(g.edges[gone]);
      free_list(g.elements[gone]);
    }
  }
  std::erase_if(front, [&](Index i) { return !g.variables.alive[i]; });
}

// Takes those of this stage that have no neighbours outside the front out of it.
std::vector<Index> take_mass(QuotientGraph& g, int stage, std::vector<Index>& front) {
  const auto first = std::stable_partition(front.begin(), front.end(), [&](Index i) {
    return !g.edges[i].empty() || !g.elements[i].empty() || g.stage[i] != stage;
  });
  std::vector<Index> mass(first, front.end());
  front.erase(first, front.end());
  return mass;
}

}  // namespace

QuotientGraph quotient_graph(FillGraph&& graph) {
  const std::size_t n = graph.list.size();
  QuotientGraph g;
  g.edges.resize(n);
  g.elements.resize(n);
  g.members.resize(n);
  g.is_element.assign(n, false);
  g.size.assign(n, 0);
  g.degree = graph.degree;
  g.fill.assign(n, 0);
  g.mark.assign(n, 0);
  g.counted.assign(n, 0);
  g.outside.assign(n, 0);
  for (Index v = 0; v < static_cast<Index>(n); ++v) {
    if (!graph.variables.alive[v]) continue;
    const std::span<const Index> around = neighbours(graph, v);
    g.edges[v].assign(around.begin(), around.end());
    g.fill[v] = graph.fill[v].fill;
  }
  g.variables = std::move(graph.variables);
  g.stage = std::move(graph.stage);
  return g;
}

void eliminate(QuotientGraph& g, Index p) {
  assert(g.variables.alive[p] && !g.is_element[p]);
  std::vector<Index> front = new_element(g, p);
  count_outside(g, front);
  for (Index i : front) prune(g, i);
  const std::vector<Index> mass = take_mass(g, g.stage[p], front);
  merge_indistinguishable(g, front);
  const std::int64_t size = weight(g, front);
  for (Index i : front) {
    bound_degree_and_fill(g, i, size);
    g.elements[i].push_back(p);
  }
  for (Index i : mass) absorb(g.variables, p, i);
  eliminate_members(g.variables, p, size);
  g.is_element[p] = true;
  g.size[p] = size;
  g.changed = front;
  g.members[p] = std::move(front);
}

}  // namespace sg::order
