#include "lib/marginalize/marginalize.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <deque>
#include <queue>

#include "lib/graph/replay.h"
#include "lib/marginalize/recover.h"

namespace sg::marginalize {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A factor that is no edge of the file's.
struct Made {
  Piece piece;
  std::optional<Measurement>
      measurement;  // none of what is yet to be made sparse, or stays as it is
  bool gone = false;
};

// The graph as it is by now.
struct Live {
  const At& at;
  const Rule& rule;
  graph::Lists<> edges_at;  // of every vertex
  std::deque<Made> made;
  std::vector<std::vector<Index>> made_at;  // of every vertex; those that are gone among them
  Marginalization result;
};

Live live_graph(const At& at, const std::vector<bool>& removed, const Rule& rule) {
  const Graph& graph = *at.problem.graph;
  Live live{at, rule, graph::transpose(graph.edge_vertices, graph.vertices()), {}, {}, {}};
  live.made_at.resize(graph.vertices());
  live.result.vertex = removed;
  live.result.edge.assign(graph.edges(), false);
  return live;
}

void add(Live& live, Piece piece, std::optional<Measurement> measurement = {}) {
  const auto number = static_cast<Index>(live.made.size());
  for (const Index v : piece.vertices) live.made_at[v].push_back(number);
  live.made.push_back({std::move(piece), std::move(measurement)});
}

// All that stands at v, taken out of the graph and added up.
Piece take(Live& live, Index v) {
  std::vector<Piece> own;
  own.reserve(live.edges_at[v].size());
  std::vector<const Piece*> all;
  for (const Index e : live.edges_at[v]) {
    if (live.result.edge[e]) continue;
    live.result.edge[e] = true;
    own.push_back(piece_of_edge(live.at, e));
    all.push_back(&own.back());
  }
  for (const Index k : live.made_at[v]) {
    if (live.made[k].gone) continue;
    live.made[k].gone = true;
    all.push_back(&live.made[k].piece);
  }
  Piece whole = sum(live.at, all);
  for (const Index k : live.made_at[v]) live.made[k].piece = {};
  live.made_at[v] = {};
  return whole;
}

// How many vertices share a factor with v, v among them.
std::size_t blanket_size(const Live& live, Index v) {
  std::vector<Index> all;
  const auto insert = [&](std::span<const Index> vertices) {
    all.insert(all.end(), vertices.begin(), vertices.end());
  };
  for (const Index e : live.edges_at[v]) {
    if (!live.result.edge[e]) insert(live.at.problem.graph->edge(e));
  }
  for (const Index k : live.made_at[v]) {
    if (!live.made[k].gone) insert(live.made[k].piece.vertices);
  }
  std::ranges::sort(all);
  return std::unique(all.begin(), all.end()) - all.begin();
}

// Eliminates these vertices, those with few neighbours first, and leaves exact pieces: they are those made since.
void eliminate(Live& live, std::span<const Index> cluster) {
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
    if (rest.vertices.size() > 1 || rest.absolute) add(live, std::move(rest));
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

// Where the recovered measurements would have their vertices: so that the gradient of what they are of is theirs, and
// the minimum of the whole stays where it is. Where something is not known at all, where the piece has them.
VectorXd mean(const Blanket& blanket, const std::vector<Pair>& pairs,
              const std::vector<Index>& chosen, const Recovery& recovery) {
  if (!blanket.regular) return blanket.covariance * blanket.gradient;
  MatrixXd Q = MatrixXd::Zero(blanket.information.rows(), blanket.information.cols());
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const MatrixXd& J = pairs[chosen[k]].slope;
    Q.noalias() += J.transpose() * recovery.information[k] * J;
  }
  return Eigen::LLT<MatrixXd>(Q).solve(blanket.gradient);
}

// Makes measurements know no more than the blanket, as they are linearized with the errors that they have at the
// estimates, and not without as they were recovered.
void temper(const At& at, const Blanket& blanket, std::vector<Measurement>& measurements) {
  std::vector<Piece> pieces;
  std::vector<const Piece*> all;
  pieces.reserve(measurements.size());
  for (const Measurement& measurement : measurements) {
    pieces.push_back(piece_of(at, measurement));
    all.push_back(&pieces.back());
  }
  const Piece whole = sum(at, all);  // of all vertices of the blanket: they span it
  const MatrixXd Q = whole.information(blanket.scalars, blanket.scalars);
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> ratios(Q, blanket.information,
                                                                  Eigen::EigenvaluesOnly);
  const double most = ratios.eigenvalues().maxCoeff();
  for (Measurement& measurement : measurements) measurement.information /= std::max(1.0, most);
}

// A piece becomes measurements.
void make_sparse(Live& live, const Piece& piece, std::span<const Index> cluster) {
  const At& at = live.at;
  if (piece.information.isZero(0)) return;
  const Blanket around = blanket(at, piece);
  const std::vector<Pair> pairs = candidate_pairs(at, piece, around);
  const Tree tree = spanning_tree(at, around, pairs, piece.absolute);
  if (tree.missing >= 0) throw unrecoverable(live, cluster, tree.missing);
  const auto chosen = chosen_pairs(at, piece, around, pairs, tree, live.rule.sparsity);
  std::vector<MatrixXd> slopes;
  for (const Index k : chosen) slopes.push_back(pairs[k].slope);
  const Recovery recovery =
      recover(slopes, around.covariance, {.conservative = live.rule.conservative});
  live.result.divergence += recovery.divergence;

  const VectorXd step = mean(around, pairs, chosen, recovery);
  const auto step_of = [&](Index v) -> VectorXd {
    const auto place = std::ranges::find(around.vertices, v) - around.vertices.begin();
    const int dim = v < 0 ? 0 : at.dim(v);
    if (v < 0 || around.start[place] < 0) return VectorXd::Zero(dim);
    return step.segment(around.start[place], dim);
  };
  std::vector<Measurement> measurements;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const Measurable& of = pairs[chosen[k]].of;
    measurements.push_back(
        {of, measured(at, of, step_of(of.first), step_of(of.second)), recovery.information[k]});
  }
  if (live.rule.conservative) temper(at, around, measurements);
  for (Measurement& measurement : measurements) {
    Piece own = piece_of(at, measurement);
    add(live, std::move(own), std::move(measurement));
  }
}

std::vector<std::vector<Index>> clusters(const Graph& graph, const std::vector<bool>& removed,
                                         Clusters kind) {
  std::vector<std::vector<Index>> result;
  if (kind == Clusters::global) {
    std::vector<Index> all;
    for (Index v = 0; v < graph.vertices(); ++v) {
      if (removed[v]) all.push_back(v);
    }
    return {all};
  }
  const graph::PoseIndex poses = graph::pose_index(graph);
  Index last = -2;  // pose index of the last one that goes
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (!removed[v]) continue;
    const Index index = poses.index[v];
    const bool runs_on = kind == Clusters::batch && index >= 0 && index == last + 1;
    if (runs_on) {
      result.back().push_back(v);
    } else {
      result.push_back({v});
    }
    if (index >= 0) last = index;
  }
  return result;
}

// The id of a sensor that is where its pose is; its line, if the file has none, goes before those that need it.
Id sensor(const Live& live, std::string& lines) {
  const Graph& graph = *live.at.problem.graph;
  Id free = 0;
  std::vector<double> numbers;
  std::vector<Id> seen;
  for (const graph::Param& param : graph.params) {
    free = std::max(free, param.id + 1);
    graph::param_numbers(graph, param, numbers);
    const bool first = std::ranges::count(seen, param.id) == 0;
    seen.push_back(param.id);
    if (param.type == graph::ParamTag::se3_offset && first &&
        numbers == std::vector<double>{0, 0, 0, 0, 0, 0, 1})
      return param.id;
  }
  lines += std::string(graph::name(graph::ParamTag::se3_offset)) + " " + std::to_string(free) +
           " 0 0 0 0 0 0 1\n";
  return free;
}

void write_lines(Live& live) {
  std::string& lines = live.result.lines;
  Id parameter_id = -1;
  for (const Made& made : live.made) {
    if (made.gone) continue;
    if (made.measurement) {
      const bool wants = parameter(made.measurement->of.type).has_value();
      if (wants && parameter_id < 0) parameter_id = sensor(live, lines);
      lines += line(*live.at.problem.graph, *made.measurement, parameter_id);
    } else {
      lines += linear_line(live.at, made.piece);
    }
    ++live.result.factors;
  }
}

}  // namespace

Marginalization marginalize(const At& at, const std::vector<bool>& removed, const Rule& rule,
                            const std::function<void(Index)>& progress) {
  Live live = live_graph(at, removed, rule);
  Index gone = 0;
  const Clusters kind = rule.linear ? Clusters::global : rule.clusters;
  for (const auto& cluster : clusters(*at.problem.graph, removed, kind)) {
    const std::size_t before = live.made.size();
    eliminate(live, cluster);
    const std::size_t after = live.made.size();
    for (std::size_t k = before; k < after && !rule.linear; ++k) {
      if (live.made[k].gone) continue;
      live.made[k].gone = true;
      const Piece piece = std::exchange(live.made[k].piece, {});
      make_sparse(live, piece, cluster);
    }
    gone += static_cast<Index>(cluster.size());
    if (progress) progress(gone);
  }
  write_lines(live);
  return std::move(live.result);
}

}  // namespace sg::marginalize
