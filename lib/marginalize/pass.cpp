#include "lib/marginalize/pass.h"

#include <algorithm>
#include <queue>
#include <utility>

#include "lib/marginalize/live.h"

namespace sg::marginalize {
namespace {

using Eigen::MatrixXd;

struct Pass {
  Live live;
  const Rule& rule;
  Prices* prices;  // of topology ec
  RecoveryOptions how;
  double divergence = 0;
};

void make_sparse(Pass& pass, const Piece& piece, std::span<const Index> cluster);

// Eliminates these vertices, those with few neighbours first, and leaves exact pieces: they are those made since that are
// no measurements. A piece that is too large is made sparse at once.
void eliminate(Pass& pass, std::span<const Index> cluster) {
  Live& live = pass.live;
  using Entry = std::pair<std::size_t, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const Index v : cluster) queue.emplace(cluster.size() > 1 ? blanket_size(live, v) : 0, v);
  while (!queue.empty()) {
    const auto [size, v] = queue.top();
    queue.pop();
    if (!queue.empty()) {
      const std::size_t now = blanket_size(live, v);
      if (Entry(now, v) > queue.top()) {
        queue.emplace(now, v);
        continue;
      }
    }
    const Piece whole = take(live, v);
    if (whole.vertices.size() < 2) continue;
    Piece rest = eliminated(live.at, whole, v);
    if (rest.vertices.size() < 2 && !rest.absolute) {
      owe(live, rest);  // it knows nothing, but v may have been owed something
      continue;
    }
    if (queue.empty() || pass.rule.linear || rest.gradient.size() <= most_scalars) {
      add(live, std::move(rest));
    } else {
      make_sparse(pass, rest, cluster);
    }
  }
}

text::Error unrecoverable(const Live& live, std::span<const Index> cluster, Index missing) {
  const Graph& graph = *live.at.problem.graph;
  const std::string cause =
      " cannot be taken out: no measurement between two vertices would say where " +
      graph.type_of_vertex(missing).tag + " " + std::to_string(graph.id[missing]) +
      " is beside its other neighbours (--topology dense leaves a linear factor)";
  for (const Index v : cluster) {
    for (const Index e : live.edges_at[v]) {
      if (std::ranges::count(graph.edge(e), missing) > 0)
        return graph::error_at(graph, graph.edge_line[e],
                               "vertex " + std::to_string(graph.id[v]) + " of this " +
                                   graph.type_of_edge(e).tag + cause);
    }
  }
  return graph::error_at(graph, graph.vertex_line[cluster.front()],
                         "vertex " + std::to_string(graph.id[cluster.front()]) + cause);
}

// A piece becomes measurements that say what the estimates say; its gradient is owed.
void make_sparse(Pass& pass, const Piece& piece, std::span<const Index> cluster) {
  Live& live = pass.live;
  const At& at = live.at;
  owe(live, piece);
  if (piece.information.isZero(0)) return;
  const Blanket around = blanket(at, piece);
  const std::vector<Pair> pairs = candidate_pairs(at, piece, around);
  const auto dearer = [&](const Pair& pair) {
    return pass.prices->rate * elim::to_double(price(*pass.prices, pair.of));
  };
  const Tree tree = pass.prices ? spanning_tree(at, around, pairs, piece.absolute, dearer)
                                : spanning_tree(at, around, pairs, piece.absolute);
  if (tree.missing >= 0) throw unrecoverable(live, cluster, tree.missing);
  auto chosen = chosen_pairs(at, piece, around, pairs, tree, pass.rule.sparsity);
  if (pass.prices) {
    const auto further = worth_their_price(around, pairs, tree, *pass.prices);
    chosen.insert(chosen.end(), further.begin(), further.end());
    std::ranges::sort(chosen);
  }
  Recovery recovery = recover(slopes(around, pairs, chosen), around.covariance, pass.how);
  pass.divergence += recovery.divergence;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const Measurable& of = pairs[chosen[k]].of;
    Measurement measurement{of, measured(at, of), std::move(recovery.information[k])};
    Piece own = piece_of(at, measurement);
    own.gradient.setZero();  // but for rounding it is
    add(live, std::move(own), std::move(measurement));
  }
}

// Looks for what cannot be recovered, as far as that is told by types.
void check_types(const Live& live, std::span<const std::vector<Index>> clusters) {
  const Graph& graph = *live.at.problem.graph;
  for (const std::vector<Index>& cluster : clusters) {
    std::vector<Index> around;
    bool absolute = false;
    for (const Index v : cluster) {
      for (const Index e : live.edges_at[v]) {
        const auto ends = graph.edge(e);
        around.insert(around.end(), ends.begin(), ends.end());
        absolute |= is_absolute(live.at, e);
      }
    }
    std::ranges::sort(around);
    around.erase(std::unique(around.begin(), around.end()), around.end());
    std::erase_if(around, [&](Index v) { return std::ranges::binary_search(cluster, v); });
    const Index missing = around.size() > 1 ? out_of_reach(live.at, around, absolute) : -1;
    if (missing >= 0) throw unrecoverable(live, cluster, missing);
  }
}

}  // namespace

Draft one_pass(const At& at, const std::vector<bool>& removed, const Rule& rule, Prices* prices,
               const Progress& progress, const RecoveryOptions& how) {
  Pass pass{live_graph(at), rule, prices, how};
  pass.how.conservative = rule.conservative;
  Live& live = pass.live;
  const auto all =
      clusters(*at.problem.graph, removed, rule.linear ? Clusters::global : rule.clusters);
  if (!rule.linear) check_types(live, all);
  Index gone = 0;
  for (const auto& cluster : all) {
    const std::size_t before = live.made.size();
    eliminate(pass, cluster);
    const std::size_t after = live.made.size();
    for (std::size_t k = before; k < after && !rule.linear; ++k) {
      if (live.made[k].gone || live.made[k].measurement) continue;
      live.made[k].gone = true;
      const Piece piece = std::exchange(live.made[k].piece, {});
      make_sparse(pass, piece, cluster);
    }
    gone += static_cast<Index>(cluster.size());
    if (progress) progress(gone);
  }
  Draft draft{std::move(live.edge_gone), {}, {}, std::move(live.owed), pass.divergence};
  for (Made& made : live.made) {
    if (made.gone) continue;
    if (made.measurement) {
      draft.measurements.push_back(std::move(*made.measurement));
    } else {
      draft.linear.push_back(std::move(made.piece));
    }
  }
  return draft;
}

std::vector<Index> ends_of(const Measurable& of) {
  if (of.second < 0) return {of.first};
  return {std::min(of.first, of.second), std::max(of.first, of.second)};
}

graph::GraphPattern pattern_left(const Graph& graph, const std::vector<bool>& removed,
                                 const std::vector<bool>& edge_gone,
                                 const graph::Lists<>& factors) {
  std::vector<bool> vertex = removed, edge = edge_gone;
  vertex.flip();
  edge.flip();
  graph::GraphPattern left = graph::graph_pattern(graph, vertex, edge);
  std::vector<Index> row;
  for (Index k = 0; k < factors.size(); ++k) {
    row.clear();
    for (const Index v : factors[k]) {
      if (left.vertex_variable[v] >= 0) row.push_back(left.vertex_variable[v]);
    }
    left.pattern.rows.add(row);
  }
  return left;
}

graph::Lists<> factors_of(std::span<const Measurement> measurements) {
  graph::Lists<> factors;
  for (const Measurement& m : measurements) factors.add(ends_of(m.of));
  return factors;
}

}  // namespace sg::marginalize
