#include "lib/marginalize/live.h"

#include <algorithm>

namespace sg::marginalize {

Live live_graph(const At& at) {
  const Graph& graph = *at.problem.graph;
  Live live{at,
            graph::transpose(graph.edge_vertices, graph.vertices()),
            std::vector<std::vector<Index>>(graph.vertices()),
            starts_of_all(at),
            {},
            {}};
  live.owed = Eigen::VectorXd::Zero(live.start.back());
  live.edge_gone.assign(graph.edges(), false);
  return live;
}

void add(Live& live, Piece piece, std::optional<Measurement> measurement) {
  const auto number = static_cast<Index>(live.made.size());
  for (const Index v : piece.vertices) live.made_at[v].push_back(number);
  live.made.push_back({std::move(piece), std::move(measurement)});
}

Piece take(Live& live, Index v) {
  std::vector<Piece> own;
  own.reserve(live.edges_at[v].size());
  std::vector<const Piece*> all;
  for (const Index e : live.edges_at[v]) {
    if (live.edge_gone[e]) continue;
    live.edge_gone[e] = true;
    own.push_back(piece_of_edge(live.at, e));
    all.push_back(&own.back());
  }
  for (const Index k : live.made_at[v]) {
    if (live.made[k].gone) continue;
    live.made[k].gone = true;
    all.push_back(&live.made[k].piece);
  }
  Piece whole = sum(live.at, all);
  if (!all.empty()) {
    const std::vector<int> start = starts(live.at, whole.vertices);
    const auto place = std::ranges::lower_bound(whole.vertices, v) - whole.vertices.begin();
    auto owed = live.owed.segment(live.start[v], live.at.dim(v));
    whole.gradient.segment(start[place], live.at.dim(v)) += owed;
    owed.setZero();
  }
  for (const Index k : live.made_at[v]) live.made[k].piece = {};
  live.made_at[v] = {};
  return whole;
}

void owe(Live& live, const Piece& piece) {
  const std::vector<int> start = starts(live.at, piece.vertices);
  for (std::size_t k = 0; k < piece.vertices.size(); ++k)
    live.owed.segment(live.start[piece.vertices[k]], start[k + 1] - start[k]) +=
        piece.gradient.segment(start[k], start[k + 1] - start[k]);
}

std::size_t blanket_size(Live& live, Index v) {
  std::erase_if(live.made_at[v], [&](Index k) { return live.made[k].gone; });
  std::vector<Index> all;
  const auto insert = [&](std::span<const Index> vertices) {
    all.insert(all.end(), vertices.begin(), vertices.end());
  };
  for (const Index e : live.edges_at[v]) {
    if (!live.edge_gone[e]) insert(live.at.problem.graph->edge(e));
  }
  for (const Index k : live.made_at[v]) insert(live.made[k].piece.vertices);
  std::ranges::sort(all);
  return std::unique(all.begin(), all.end()) - all.begin();
}

}  // namespace sg::marginalize
