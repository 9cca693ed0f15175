#include "lib/marginalize/marginalize.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <queue>

#include "lib/graph/components.h"
#include "lib/graph/replay.h"
#include "lib/marginalize/errors.h"
#include "lib/marginalize/prices.h"
#include "lib/marginalize/recover.h"
#include "lib/order/order.h"

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
  Prices* prices;           // of topology ec
  double gap;               // of what is recovered (recover.h)
  graph::Lists<> edges_at;  // of every vertex
  std::deque<Made> made = {};
  std::vector<std::vector<Index>> made_at = {};  // of every vertex; those that are gone among them
  std::vector<int> start = {};                   // of every vertex in the scalars of all
  VectorXd owed = {};                            // gradient that what is recovered does not have
  Marginalization result = {};
};

Live live_graph(const At& at, const std::vector<bool>& removed, const Rule& rule, Prices* prices,
                double gap) {
  const Graph& graph = *at.problem.graph;
  Live live{at, rule, prices, gap, graph::transpose(graph.edge_vertices, graph.vertices())};
  live.made_at.resize(graph.vertices());
  live.start = {0};
  for (Index v = 0; v < graph.vertices(); ++v) live.start.push_back(live.start.back() + at.dim(v));
  live.owed = VectorXd::Zero(live.start.back());
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

// How many vertices share a factor with v, v among them.
std::size_t blanket_size(Live& live, Index v) {
  std::erase_if(live.made_at[v], [&](Index k) { return live.made[k].gone; });
  std::vector<Index> all;
  const auto insert = [&](std::span<const Index> vertices) {
    all.insert(all.end(), vertices.begin(), vertices.end());
  };
  for (const Index e : live.edges_at[v]) {
    if (!live.result.edge[e]) insert(live.at.problem.graph->edge(e));
  }
  for (const Index k : live.made_at[v]) insert(live.made[k].piece.vertices);
  std::ranges::sort(all);
  return std::unique(all.begin(), all.end()) - all.begin();
}

void make_sparse(Live& live, const Piece& piece, std::span<const Index> cluster);

// Eliminates these vertices, those with few neighbours first, and leaves exact pieces: they are those made since that are
// no measurements. A piece that is too large is made sparse at once.
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
    if (rest.vertices.size() < 2 && !rest.absolute) continue;
    if (queue.empty() || live.rule.linear || rest.gradient.size() <= most_scalars) {
      add(live, std::move(rest));
    } else {
      make_sparse(live, rest, cluster);
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
void make_sparse(Live& live, const Piece& piece, std::span<const Index> cluster) {
  const At& at = live.at;
  const std::vector<int> start = starts(at, piece.vertices);
  for (std::size_t k = 0; k < piece.vertices.size(); ++k)
    live.owed.segment(live.start[piece.vertices[k]], start[k + 1] - start[k]) +=
        piece.gradient.segment(start[k], start[k + 1] - start[k]);
  if (piece.information.isZero(0)) return;
  const Blanket around = blanket(at, piece);
  const std::vector<Pair> pairs = candidate_pairs(at, piece, around);
  const auto dearer = [&](const Pair& pair) {
    return live.prices->rate * elim::to_double(price(*live.prices, pair.of));
  };
  const Tree tree = live.prices ? spanning_tree(at, around, pairs, piece.absolute, dearer)
                                : spanning_tree(at, around, pairs, piece.absolute);
  if (tree.missing >= 0) throw unrecoverable(live, cluster, tree.missing);
  auto chosen = chosen_pairs(at, piece, around, pairs, tree, live.rule.sparsity);
  if (live.prices) {
    const auto further = worth_their_price(around, pairs, tree, *live.prices);
    chosen.insert(chosen.end(), further.begin(), further.end());
    std::ranges::sort(chosen);
  }
  std::vector<MatrixXd> slopes;
  for (const Index k : chosen) slopes.push_back(spread(around, pairs[k]));
  Recovery recovery =
      recover(slopes, around.covariance, {.conservative = live.rule.conservative, .gap = live.gap});
  live.result.divergence += recovery.divergence;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const Measurable& of = pairs[chosen[k]].of;
    Measurement measurement{of, measured(at, of), std::move(recovery.information[k])};
    Piece own = piece_of(at, measurement);
    own.gradient.setZero();  // but for rounding it is
    add(live, std::move(own), std::move(measurement));
  }
}

// The removed vertices that edges connect.
std::vector<std::vector<Index>> connected(const Graph& graph, const std::vector<bool>& removed) {
  graph::DisjointSets parts(graph.vertices());
  for (Index e = 0; e < graph.edges(); ++e) {
    Index first = -1;
    for (const Index v : graph.edge(e)) {
      if (!removed[v]) continue;
      if (first >= 0) join(parts, first, v);
      first = v;
    }
  }
  std::vector<Index> part(graph.vertices(), -1);
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (removed[v]) part[v] = find(parts, v);
  }
  const graph::Lists<> lists = graph::grouped(part, graph.vertices());
  std::vector<std::vector<Index>> result;
  for (Index k = 0; k < lists.size(); ++k) {
    if (!lists[k].empty()) result.emplace_back(lists[k].begin(), lists[k].end());
  }
  return result;
}

std::vector<std::vector<Index>> clusters(const Graph& graph, const std::vector<bool>& removed,
                                         Clusters kind) {
  if (kind == Clusters::global) return connected(graph, removed);
  std::vector<std::vector<Index>> result;
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
    live.result.factors.add(made.piece.vertices);
  }
}

void set_errors(Live& live) {
  std::vector<Measurement*> measurements;
  for (Made& made : live.made) {
    if (!made.gone) measurements.push_back(&*made.measurement);
  }
  set_errors(live.at, live.owed, live.rule.conservative, measurements);
}

using Progress = std::function<void(Index)>;

Marginalization one_pass(const At& at, const std::vector<bool>& removed, const Rule& rule,
                         Prices* prices, const Progress& progress,
                         double gap = RecoveryOptions{}.gap) {
  Live live = live_graph(at, removed, rule, prices, gap);
  const auto all =
      clusters(*at.problem.graph, removed, rule.linear ? Clusters::global : rule.clusters);
  if (!rule.linear) check_types(live, all);
  Index gone = 0;
  for (const auto& cluster : all) {
    const std::size_t before = live.made.size();
    eliminate(live, cluster);
    const std::size_t after = live.made.size();
    for (std::size_t k = before; k < after && !rule.linear; ++k) {
      if (live.made[k].gone || live.made[k].measurement) continue;
      live.made[k].gone = true;
      const Piece piece = std::exchange(live.made[k].piece, {});
      make_sparse(live, piece, cluster);
    }
    gone += static_cast<Index>(cluster.size());
    if (progress) progress(gone);
  }
  if (!rule.linear) set_errors(live);
  write_lines(live);
  return std::move(live.result);
}

constexpr std::string_view ordering = "wmf";  // that EC is priced in
constexpr int renewals = 1;                   // of the order, by what it left
constexpr double rough = 0.1;                 // gap of what only an order is taken of
constexpr int bracketings = 5, bisections = 6;
constexpr double step = 8;  // of prices, as long as none on the other side is known

struct Priced {
  Marginalization result;
  double ec;
};

// Topology ec at a price.
struct Market {
  const At& at;
  const std::vector<bool>& removed;
  const Rule& rule;
  const Progress& progress;
  graph::GraphPattern tree;  // what is left with trees alone
  graph::Order order;        // of that
  double unit;               // what trees lose a unit of their EC

  Priced at_price(double price) const {
    const Graph& graph = *at.problem.graph;
    graph::Order now = order;
    for (int k = 0;; ++k) {
      Prices sheet = prices(tree, now, removed, price * unit);
      Marginalization result = k == renewals ? one_pass(at, removed, rule, &sheet, progress)
                                             : one_pass(at, removed, rule, &sheet, progress, rough);
      const graph::Pattern left = pattern_left(graph, result).pattern;
      now = order::elimination_order(ordering, left);
      if (k == renewals)
        return {std::move(result), elim::to_double(elim::elimination_complexity(left, now))};
    }
  }
};

// The least price that leaves no more EC than this; else the greatest that was tried.
Marginalization within(const Market& market, double ec) {
  double price = 1, dear = 0, cheap = 0;  // 0: not known yet
  std::optional<Priced> best, last;
  for (int k = 0; k < bracketings + bisections; ++k) {
    if (k >= bracketings && (dear == 0 || cheap == 0)) break;
    last = market.at_price(price);
    const bool fits = last->ec <= ec;
    (fits ? dear : cheap) = price;
    if (fits && (!best || last->ec >= best->ec)) best = std::move(last);
    price = dear == 0 ? price * step : cheap == 0 ? price / step : std::sqrt(dear * cheap);
  }
  return std::move((best ? best : last)->result);
}

}  // namespace

graph::GraphPattern pattern_left(const Graph& graph, const Marginalization& result) {
  std::vector<bool> vertex = result.vertex, edge = result.edge;
  vertex.flip();
  edge.flip();
  graph::GraphPattern left = graph::graph_pattern(graph, vertex, edge);
  std::vector<Index> row;
  for (Index k = 0; k < result.factors.size(); ++k) {
    row.clear();
    for (const Index v : result.factors[k]) {
      if (left.vertex_variable[v] >= 0) row.push_back(left.vertex_variable[v]);
    }
    left.pattern.rows.add(row);
  }
  return left;
}

Marginalization marginalize(const At& at, const std::vector<bool>& removed, const Rule& rule,
                            const Progress& progress) {
  if (rule.linear || rule.sparsity.topology != Topology::ec)
    return one_pass(at, removed, rule, nullptr, progress);
  const Graph& graph = *at.problem.graph;
  Rule sparsest = rule;
  sparsest.sparsity.topology = Topology::tree;
  const Marginalization trees = one_pass(at, removed, sparsest, nullptr, progress);
  Market market{at, removed, rule, progress, pattern_left(graph, trees), {}, 0};
  market.order = order::elimination_order(ordering, market.tree.pattern);
  const double ec =
      elim::to_double(elim::elimination_complexity(market.tree.pattern, market.order));
  market.unit = std::max(trees.divergence, 0.0) / std::max(ec, 1.0);
  return rule.sparsity.ec ? within(market, *rule.sparsity.ec)
                          : market.at_price(rule.sparsity.price).result;
}

}  // namespace sg::marginalize
