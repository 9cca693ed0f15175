#include "lib/order/polish.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "lib/order/constraint.h"
#include "lib/order/dissect.h"
#include "lib/order/region.h"
#include "lib/order/stopwatch.h"
#include "lib/order/wmf.h"
#include "lib/parallel/parallel.h"

namespace sg::order {
namespace {

constexpr std::array sizes{64, 512, 4096};  // of regions, one sweep each in every round
constexpr std::array scales{1.0,  1.5, 0.75,
                            1.25, 0.6, 2.0};  // of the sizes, by round: borders move
constexpr int exchanges_a_round = 6;
constexpr double least_gain = 3e-4;  // of EC, by one of two rounds

// Of R and B, as fill_graph.h has parts: no two of B are joined.
graph::Adjacency part_graph(const Region& region) {
  const auto inner = static_cast<Index>(region.inside.size());
  std::vector<std::pair<Index, Index>> edges;
  for (Index r = 0; r < region.pattern.rows.size(); ++r) {
    const auto row = region.pattern.rows[r];
    for (const Index u : row) {
      if (u >= inner) continue;
      for (const Index v : row) {
        if (u == v) continue;
        edges.emplace_back(u, v);
        if (v >= inner) edges.emplace_back(v, u);
      }
    }
  }
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  graph::Adjacency graph;
  std::size_t at = 0;
  for (Index v = 0; v < region.pattern.variables(); ++v) {
    for (; at < edges.size() && edges[at].first == v; ++at) graph.items.push_back(edges[at].second);
    graph.close();
  }
  return graph;
}

// Whether a region is one clique with what is around it: nothing can be gained there.
bool is_clique(const graph::Adjacency& graph, Index inner) {
  const auto joined = static_cast<std::size_t>(graph.size()) - 1;
  for (Index v = 0; v < inner; ++v) {
    if (graph[v].size() < joined) return false;
  }
  return true;
}

// A better order of a region, of which this is the graph; empty if none was found.
graph::Order reordered(const Region& region, const graph::Adjacency& graph) {
  const auto inner = static_cast<Index>(region.inside.size());
  const std::vector<int>& dim = region.pattern.dim;
  elim::Wide best = region.ec;
  graph::Order order;
  GreedyResult greedy = greedy_fill_of_part(graph, dim, inner);
  if (greedy.ec < best) {
    best = greedy.ec;
    order = std::move(greedy.order);
  }
  if (is_wide(graph, best)) {
    Dissected dissected = nested_dissection(graph, dim, inner, 0);
    if (dissected.ec < best) order = std::move(dissected.order);
  }
  return order;
}

// The same, or else, of a clique, with the variables first that need not meet all others, so that those after them meet
// fewer.
graph::Order slimmed(const Region& region, const graph::Adjacency& graph) {
  graph::Order order = reordered(region, graph);
  if (!order.empty()) return order;
  const auto joined = static_cast<std::size_t>(graph.size()) - 1;
  order.resize(static_cast<std::size_t>(graph.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_partition(order.begin(), order.begin() + std::ssize(region.inside),
                        [&](Index v) { return graph[v].size() < joined; });
  return order;
}

bool stopped(const PolishOptions& options, double seconds) {
  return options.stop && options.stop(seconds);
}

// The order after every region has had its turn that there was time for, and for the seconds that it takes afterwards.
graph::Order swept(const Elimination& elimination, const std::vector<Region>& regions,
                   graph::Order (*better)(const Region&, const graph::Adjacency&),
                   const PolishOptions& options, double afterwards) {
  std::vector<graph::Order> orders(regions.size());
  parallel::each(regions.size(), [&](std::size_t k) {
    const auto inner = static_cast<Index>(regions[k].inside.size());
    if (stopped(options, afterwards) || inner < 2) return;
    const graph::Adjacency graph = part_graph(regions[k]);
    if (!is_clique(graph, inner)) orders[k] = better(regions[k], graph);
  });
  return recut(elimination, regions, orders);
}

// The order after exchanges of adjacent cliques.
graph::Order exchanged(const Elimination& elimination, const std::vector<bool>& left_out) {
  std::vector<graph::Order> orders;
  const std::vector<Region> regions = exchanges(elimination, left_out, orders);
  return recut(elimination, regions, orders);
}

// Of `last`, and all that the tree has above them.
std::vector<bool> positions_left_out(const Elimination& elimination,
                                     const std::vector<bool>& is_last) {
  std::vector<bool> out(is_last.size());
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (is_last[elimination.order[k]]) out[k] = true;
    if (const Index p = elimination.parent[k]; out[k] && p >= 0) out[p] = true;
  }
  return out;
}

}  // namespace

Polished polish(const graph::Pattern& pattern, const graph::Order& order,
                const PolishOptions& options) {
  std::vector<bool> is_last(order.size(), false);
  for (const Index j : options.last) is_last.at(j) = true;
  const Stopwatch watch;
  Elimination best = elimination(pattern, order);
  // What no stop can cut short of a sweep: about this before its regions, and as much after them.
  const double alone = 2 * watch.seconds();
  double before = elim::to_double(best.ec);
  const auto sweep = [&](const auto& next) {
    if (stopped(options, 2 * alone)) return false;
    best = elimination(pattern, next(positions_left_out(best, is_last)));
    return true;
  };
  int idle = 0;
  for (int round = 0; round < options.rounds && idle < 2 && !best.order.empty(); ++round) {
    const double scale = scales[static_cast<std::size_t>(round) % scales.size()];
    for (const Index least : sizes) {
      const auto size = static_cast<Index>(scale * least);
      const auto by_regions = [&](const auto& out) {
        return swept(best, cut(best, size, out), reordered, options, alone);
      };
      if (!sweep(by_regions)) break;
    }
    elim::Wide last = 0;
    for (int k = 0; k < exchanges_a_round && best.ec != last; ++k) {
      last = best.ec;
      if (!sweep([&](const auto& out) { return exchanged(best, out); })) break;
    }
    const double after = elim::to_double(best.ec);
    idle = after > (1 - least_gain) * before ? idle + 1 : 0;
    before = after;
  }
  const auto by_cliques = [&](const auto& out) {
    return swept(best, cliques(best, out), slimmed, options, alone);
  };
  for (elim::Wide last = 0; best.ec != last;) {
    last = best.ec;
    if (!sweep(by_cliques)) break;
  }
  move_to_end(best.order, options.last);  // a postorder may have put some of them before others
  return {std::move(best.order), best.ec};
}

}  // namespace sg::order
