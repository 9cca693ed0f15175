#include "lib/prune/tgreedy.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "lib/graph/components.h"
#include "lib/graph/lists.h"
#include "lib/text/error.h"
#include "lib/trees/spanning_trees.h"

namespace sg::prune {
namespace {

// Gains that differ by rounding errors alone become equal.
double rounded(double gain) {
  int exponent = 0;
  const double mantissa = std::frexp(gain, &exponent);
  return std::ldexp(std::round(std::ldexp(mantissa, 30)), exponent - 30);
}

// What a candidate is worth; `version` counts the links of the graph in which it was computed.
struct Worth {
  int joins;  // layers in which it joins two parts
  double gain;
  Index edge;
  std::int64_t version;
  bool operator<(const Worth& other) const {
    if (joins != other.joins) return joins < other.joins;
    if (gain != other.gain) return gain < other.gain;
    return edge > other.edge;
  }
};

struct Layer {
  double multiplicity;
  std::vector<double> weight;  // by edge
  trees::SpanningTrees trees;
};

struct Greedy {
  std::vector<trees::Edge> link;  // by edge; u == v where it links nothing
  std::vector<Layer> layers;
  std::priority_queue<Worth> waiting;
  std::int64_t version = 0;
  std::vector<Accepted> accepted;
};

trees::Edge candidate_link(const Graph& graph, const trees::Nodes& nodes, Index e) {
  const auto ends = graph.edge(e);
  if (ends.size() == 2) return {nodes.node[ends[0]], nodes.node[ends[1]]};
  throw graph::error_at(graph, graph.edge_line[e],
                        graph.type_of_edge(e).tag + " joins " + std::to_string(ends.size()) +
                            " vertices: only edges of two can be candidates for spanning trees");
}

void require_weights(const Graph& graph, const std::vector<Index>& candidates,
                     const std::vector<trees::Layer>& layers) {
  for (const trees::Layer& layer : layers) {
    if (std::any_of(candidates.begin(), candidates.end(),
                    [&](Index e) { return layer.weight[e] > 0; }))
      return;
  }
  if (!candidates.empty())
    throw text::input_error(graph.file, 0, "no candidate has a weight of this kind: all are zero");
}

// The graph of the edges marked `present`, on a pattern of all.
Greedy start(const Graph& graph, const graph::Lists<trees::Edge>& all, const trees::Nodes& nodes,
             const std::vector<Index>& candidates, trees::Weights kind,
             const std::vector<bool>& present) {
  Greedy greedy;
  greedy.link.assign(graph.edges(), {0, 0});
  for (Index e : candidates) greedy.link[e] = candidate_link(graph, nodes, e);
  std::vector<trees::Layer> layers = trees::tree_layers(graph, kind);
  require_weights(graph, candidates, layers);
  for (trees::Layer& layer : layers) {
    std::vector<double> weight(all.items.size(), 0);
    for (Index e = 0; e < graph.edges(); ++e) {
      if (!present[e]) continue;
      std::fill(weight.begin() + all.begin[e], weight.begin() + all.begin[e + 1], layer.weight[e]);
    }
    trees::SpanningTrees trees = trees::spanning_trees(nodes.count, all.items, weight);
    greedy.layers.push_back({layer.multiplicity, std::move(layer.weight), std::move(trees)});
  }
  return greedy;
}

Worth worth(Greedy& greedy, Index e) {
  Worth result{0, 0, e, greedy.version};
  for (Layer& layer : greedy.layers) {
    if (layer.weight[e] <= 0) continue;
    result.joins += !trees::joined(layer.trees, greedy.link[e]);
    result.gain += layer.multiplicity * trees::gain(layer.trees, greedy.link[e], layer.weight[e]);
  }
  result.gain = rounded(result.gain);
  return result;
}

void offer(Greedy& greedy, Index e) {
  const int all = static_cast<int>(greedy.layers.size());
  greedy.waiting.push({all, HUGE_VAL, e, -1});
}

void accept(Greedy& greedy, const Worth& chosen) {
  Accepted step{chosen.edge, chosen.joins > 0, 0, 0};
  for (Layer& layer : greedy.layers) {
    const double weight = layer.weight[chosen.edge];
    if (weight > 0)
      step.gain +=
          layer.multiplicity * trees::add_link(layer.trees, greedy.link[chosen.edge], weight);
    step.criterion += layer.multiplicity * layer.trees.log_trees;
  }
  ++greedy.version;
  greedy.accepted.push_back(step);
}

// Accepts the best of those that wait until `total` are accepted. Whether to go on after that.
bool spend(Greedy& greedy, std::size_t total, const GoOn& go_on) {
  while (greedy.accepted.size() < total && !greedy.waiting.empty()) {
    if (go_on && !go_on(greedy.accepted.size())) return false;
    Worth top = greedy.waiting.top();
    greedy.waiting.pop();
    if (top.version != greedy.version) {
      top = worth(greedy, top.edge);
      if (!greedy.waiting.empty() && top < greedy.waiting.top()) {
        greedy.waiting.push(top);
        continue;
      }
    }
    accept(greedy, top);
  }
  return true;
}

// Edges by the batch of the replay that they come with; those that never enter come last.
graph::Lists<> by_batch(const Graph& graph, const graph::PoseIndex& poses, Index batch) {
  const graph::Replay steps = graph::replay(graph, poses);
  const Index batches = std::max<Index>(1, (steps.steps + batch - 1) / batch);
  std::vector<Index> when(graph.edges());
  for (Index e = 0; e < graph.edges(); ++e)
    when[e] = steps.edge_step[e] < 0 ? batches - 1 : steps.edge_step[e] / batch;
  return graph::grouped(when, batches);
}

}  // namespace

std::vector<Accepted> tgreedy(const Graph& graph, const std::vector<Index>& candidates,
                              std::size_t count, trees::Weights weights, const GoOn& go_on) {
  const trees::Nodes nodes = trees::tree_nodes(graph);
  const graph::Lists<trees::Edge> all = trees::tree_links(graph, nodes);
  std::vector<bool> present(graph.edges(), true);
  for (Index e : candidates) present[e] = false;
  Greedy greedy = start(graph, all, nodes, candidates, weights, present);
  for (Index e : candidates) offer(greedy, e);
  spend(greedy, count, go_on);
  return std::move(greedy.accepted);
}

std::vector<Accepted> tgreedy_online(const Graph& graph, const graph::PoseIndex& poses,
                                     const std::vector<Index>& candidates, std::size_t count,
                                     trees::Weights weights, Index batch, const GoOn& go_on) {
  const trees::Nodes nodes = trees::tree_nodes(graph);
  const graph::Lists<trees::Edge> all = trees::tree_links(graph, nodes);
  Greedy greedy =
      start(graph, all, nodes, candidates, weights, std::vector<bool>(graph.edges(), false));
  std::vector<bool> candidate(graph.edges(), false);
  for (Index e : candidates) candidate[e] = true;
  const graph::Lists<> edges = by_batch(graph, poses, batch);
  count = std::min(count, candidates.size());
  std::size_t seen = 0;
  for (Index k = 0; k < edges.size(); ++k) {
    for (Index e : edges[k]) {
      if (candidate[e]) {
        offer(greedy, e);
        ++seen;
        continue;
      }
      for (Layer& layer : greedy.layers) {
        if (layer.weight[e] <= 0) continue;
        for (const trees::Edge& link : all[e]) trees::add_link(layer.trees, link, layer.weight[e]);
      }
      ++greedy.version;
    }
    const std::size_t share =
        seen > 0 ? (2 * count * seen + candidates.size()) / (2 * candidates.size()) : 0;
    if (!spend(greedy, share, go_on)) break;
  }
  return std::move(greedy.accepted);
}

std::vector<bool> kept_by(const std::vector<Index>& candidates,
                          std::span<const Accepted> accepted) {
  std::vector<Index> edges(accepted.size());
  std::ranges::transform(accepted, edges.begin(), &Accepted::edge);
  std::ranges::sort(edges);
  std::vector<bool> kept;
  kept.reserve(candidates.size());
  for (const Index e : candidates) kept.push_back(std::ranges::binary_search(edges, e));
  return kept;
}

Index pose_parts(const Graph& graph, const graph::PoseIndex& poses,
                 const std::vector<bool>& edge_removed) {
  const graph::Components parts = graph::components(graph, edge_removed);
  std::vector<bool> found(parts.count, false);
  for (Index v : poses.pose) found[parts.of[v]] = true;
  return static_cast<Index>(std::count(found.begin(), found.end(), true));
}

}  // namespace sg::prune
