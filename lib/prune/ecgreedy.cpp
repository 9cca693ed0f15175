#include "lib/prune/ecgreedy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

#include "lib/elim/filled_graph.h"
#include "lib/prune/candidates.h"
#include "lib/prune/information_gain.h"

namespace sg::prune {
namespace {

constexpr double growth = 1.25;          // of EC until the order is renewed
constexpr double worth_renewing = 1.01;  // at the end of a budget: what a new order has to win
constexpr Index most_added = 192;        // rows until the factor is renewed
constexpr Index sparsest = 256;          // rate of a start, before none
constexpr double most_sigma = 1e5;       // of a start, in multiples of the whole graph's
constexpr std::size_t bases = 6;         // poses about which a landmark's observations are sought

// A move that could be made.
struct Item {
  std::vector<Index> edges;  // candidates that come in
  std::vector<Index> rows;   // and what else does
  Index landmark = -1;       // variable that comes in with them
  Measurement measurement = {};
  int guessed = -1;  // the factor by which its worth was guessed
  std::optional<Tried> tried = {};
};

struct Waiting {
  double worth;  // as it was last
  Index item;
  bool operator<(const Waiting& other) const {
    return worth != other.worth ? worth < other.worth : item > other.item;
  }
};

struct Greedy {
  const Choice& choice;
  const Graph& graph;
  const Evidence& evidence;
  const EcGreedyOptions& options;
  graph::Lists<> edges_of;         // vertices
  std::vector<bool> is_candidate;  // edges
  Knowledge knowledge;
  int factors = 0;  // made so far
  Selection in = {};
  Index kept = 0;
  elim::FilledGraph filled = {};
  elim::Wide fresh_ec = 0;            // when the order was renewed
  graph::Order order = {};            // of all variables, those that are not in first
  std::vector<Index> position = {};   // in it
  std::vector<bool> unfactored = {};  // variables that came in since the factor
  std::vector<Item> items = {};
  std::priority_queue<Waiting> waiting = {};
  std::vector<Index> tried = {};         // items
  std::vector<Index> after_factor = {};  // items of variables that it does not know
  std::vector<Move> moves = {};
  std::size_t settled = 0;  // of the moves
};

// A new order of what is in.
void place_order(Greedy& greedy) {
  const graph::GraphPattern part =
      graph::graph_pattern(greedy.graph, greedy.in.vertex, greedy.in.edge);
  const graph::Order of_part = greedy.options.order(part);
  const auto n = static_cast<Index>(greedy.evidence.variable_vertex.size());
  greedy.order.clear();
  for (Index j = 0; j < n; ++j) {
    if (!greedy.in.vertex[greedy.evidence.variable_vertex[j]]) greedy.order.push_back(j);
  }
  const auto absent = static_cast<Index>(greedy.order.size());
  for (const Index k : of_part)
    greedy.order.push_back(greedy.evidence.vertex_variable[part.variable_vertex[k]]);
  greedy.position.resize(n);
  for (Index k = 0; k < n; ++k) greedy.position[greedy.order[k]] = k;
  graph::Pattern rows;
  for (Index j = 0; j < n; ++j)
    rows.dim.push_back(greedy.graph.dim(greedy.evidence.variable_vertex[j]));
  for (Index e = 0; e < greedy.graph.edges(); ++e) {
    if (greedy.in.edge[e]) rows.rows.add(greedy.evidence.pattern.rows[e]);
  }
  greedy.filled = elim::filled_graph(elim::ordered(rows, greedy.order), absent);
  greedy.fresh_ec = greedy.filled.ec;
}

std::vector<Index> refactor(Greedy& greedy) {
  greedy.unfactored.assign(greedy.evidence.variable_vertex.size(), false);
  ++greedy.factors;
  return refactor(greedy.knowledge, greedy.in, greedy.order);
}

// Where measurements hold the gauge, a selection without those may pass for determined by rounding alone: its sigma is
// beyond all measure then.
bool holds_gauge(Greedy& greedy) {
  if (greedy.evidence.held) return true;
  take_variances(greedy.knowledge);
  const auto whole = whole_sigma(greedy.choice, greedy.evidence, greedy.options);
  return whole && mean_sigma(greedy.knowledge) < most_sigma * *whole;
}

// Starts from these candidates without the landmarks that they leave undetermined. False where they leave another
// vertex so.
bool start_from(Greedy& greedy, std::vector<bool> kept) {
  while (true) {
    greedy.in = selection(greedy.choice, kept);
    place_order(greedy);
    const std::vector<Index> undetermined = refactor(greedy);
    if (undetermined.empty()) return holds_gauge(greedy);
    for (const Index j : undetermined) {
      const Index v = greedy.evidence.variable_vertex[j];
      if (greedy.graph.role(v) != graph::Role::landmark || !leave_out(greedy.choice, v, kept))
        return false;
    }
  }
}

// False where all of the graph leaves something undetermined.
bool start(Greedy& greedy) {
  const Choice& choice = greedy.choice;
  const bool sees = std::ranges::any_of(choice.candidates, [&](Index e) {
    return graph::edge_role(choice.graph, choice.poses, e) == graph::EdgeRole::observation;
  });
  Index rate = sees ? start_rate : 0;
  for (; !start_from(greedy, sparse_start(choice, rate)); rate = rate == 0 ? 1 : rate / 2) {
    if (rate == 1) return false;
  }
  while (greedy.options.start_ec && greedy.filled.ec > *greedy.options.start_ec && rate > 1) {
    const Index sparser = rate < sparsest ? 2 * rate : 0;
    if (!start_from(greedy, sparse_start(choice, sparser))) {
      start_from(greedy, sparse_start(choice, rate));
      return true;
    }
    rate = sparser;
  }
  return true;
}

std::vector<Index> factor_of(const Greedy& greedy, std::span<const Index> edges) {
  std::vector<Index> factor;
  for (const Index e : edges) {
    for (const Index j : greedy.evidence.pattern.rows[e]) factor.push_back(greedy.position[j]);
  }
  std::ranges::sort(factor);
  factor.erase(std::unique(factor.begin(), factor.end()), factor.end());
  return factor;
}

double worth(Greedy& greedy, const Item& item, const Gain& gain) {
  const elim::Wide cost =
      elim::increase(greedy.filled, factor_of(greedy, item.rows)) + edge_cost * item.edges.size();
  return (greedy.options.gain == GainKind::trace ? gain.trace : gain.log_det) /
         elim::to_double(cost);
}

double guess(Greedy& greedy, Item& item) {
  item.guessed = greedy.factors;
  return worth(greedy, item, guessed_gain(greedy.knowledge, item.measurement));
}

bool all_in(const Greedy& greedy, Index e) {
  return std::ranges::all_of(greedy.graph.edge(e), [&](Index v) { return greedy.in.vertex[v]; });
}

// Whether this vertex is the only one of the edge's that is not in.
bool brings_alone(const Greedy& greedy, Index e, Index vertex) {
  return std::ranges::all_of(greedy.graph.edge(e),
                             [&](Index v) { return v == vertex || greedy.in.vertex[v]; });
}

Item edge_item(const Greedy& greedy, Index e) {
  return {{e}, {e}, -1, measurement(greedy.evidence, e)};
}

// The variable of the pose that an edge observes from, the last if there are several; -1 for a constant.
Index observer(const Greedy& greedy, Index e) {
  Index last = -1;
  for (const Index v : greedy.graph.edge(e)) last = std::max(last, greedy.choice.poses.index[v]);
  return last < 0 ? -1 : greedy.evidence.vertex_variable[greedy.choice.poses.pose[last]];
}

// So many of a list, spread evenly.
std::vector<Index> spread(std::span<const Index> list, std::size_t count) {
  std::vector<Index> chosen;
  for (std::size_t k = 0; k < count; ++k)
    chosen.push_back(list[k * (list.size() - 1) / std::max<std::size_t>(count - 1, 1)]);
  return chosen;
}

// Those of a landmark's observations whose poses stand in the separator of `base`'s, and that: they come together for
// nothing but the landmark itself.
std::vector<Index> beside(const Greedy& greedy, std::span<const Index> edges, Index base) {
  const Index first = observer(greedy, base);
  std::vector<Index> chosen;
  if (first < 0) return chosen;
  const std::vector<Index>& separator = greedy.filled.separator[greedy.position[first]];
  for (const Index e : edges) {
    const Index j = observer(greedy, e);
    if (j < 0 || j == first || std::ranges::binary_search(separator, greedy.position[j]))
      chosen.push_back(e);
  }
  return chosen;
}

// A landmark that comes in with these of its observations, and with what else it has.
Item landmark_item(const Greedy& greedy, Index variable, std::vector<Index> edges,
                   std::span<const Index> others) {
  Item item{std::move(edges), {}, variable};
  item.rows = item.edges;
  item.rows.insert(item.rows.end(), others.begin(), others.end());
  item.measurement = without(greedy.evidence, item.rows, variable);
  return item;
}

void offer(Greedy& greedy, Item item, double value) {
  greedy.waiting.push({value, static_cast<Index>(greedy.items.size())});
  greedy.items.push_back(std::move(item));
}

// The best way for a landmark to come in: of all its observations, or of those beside one of them, so many, spread evenly.
// Two bearings determine a point and say nothing else: it takes more than the fewest.
void offer_landmark(Greedy& greedy, Index vertex) {
  const Index variable = greedy.evidence.vertex_variable[vertex];
  if (variable < 0) return;
  std::vector<Index> edges, others;
  for (const Index e : greedy.edges_of[vertex]) {
    if (brings_alone(greedy, e, vertex)) (greedy.is_candidate[e] ? edges : others).push_back(e);
  }
  if (edges.empty()) return;
  std::ranges::stable_sort(edges, {}, [&](Index e) { return observer(greedy, e); });
  std::vector<std::vector<Index>> sources{edges};
  for (const Index base : spread(edges, std::min(bases, edges.size())))
    sources.push_back(beside(greedy, edges, base));
  Item best;
  double most = -1;
  for (const std::vector<Index>& source : sources) {
    for (auto count = static_cast<std::size_t>(greedy.choice.min_obs); count <= source.size();
         count += (count + 2) / 3) {
      Item item = landmark_item(greedy, variable, spread(source, count), others);
      if (item.measurement.variables.empty()) continue;
      const double value = guess(greedy, item);
      if (value <= most) continue;
      most = value;
      best = std::move(item);
    }
  }
  if (most >= 0) offer(greedy, std::move(best), most);
}

// All moves that there are now.
void offer_all(Greedy& greedy) {
  greedy.waiting = {};
  greedy.items.clear();
  greedy.tried.clear();
  greedy.after_factor.clear();
  for (const Index e : greedy.choice.candidates) {
    if (greedy.in.edge[e] || !all_in(greedy, e)) continue;
    Item item = edge_item(greedy, e);
    const double value = guess(greedy, item);
    offer(greedy, std::move(item), value);
  }
  for (Index v = 0; v < greedy.graph.vertices(); ++v) {
    if (!greedy.in.vertex[v]) offer_landmark(greedy, v);
  }
}

// Its gain and sigma are told when it is settled.
void record(Greedy& greedy, Move::Kind kind, std::vector<Index> edges, elim::Wide increase) {
  greedy.kept += static_cast<Index>(edges.size());
  greedy.moves.push_back({kind, std::move(edges), 0, increase, greedy.filled.ec, 0, greedy.kept});
}

// What the moves since the factor have gained.
void settle_moves(Greedy& greedy) {
  for (const Settled& settled : settle(greedy.knowledge)) {
    Move& move = greedy.moves[greedy.settled++];
    move.gain = greedy.options.gain == GainKind::trace ? settled.gain.trace : settled.gain.log_det;
    move.sigma = settled.mean_sigma;
  }
}

// A factor of all that is in, in the same order.
void renew_factor(Greedy& greedy) {
  settle_moves(greedy);
  refactor(greedy);
  for (const Index i : greedy.tried) greedy.items[i].tried.reset();
  greedy.tried.clear();
  for (const Index i : greedy.after_factor) greedy.waiting.push({HUGE_VAL, i});
  greedy.after_factor.clear();
}

// A new order.
void renew_order(Greedy& greedy) {
  settle_moves(greedy);
  place_order(greedy);
  refactor(greedy);
  take_variances(greedy.knowledge);
  offer_all(greedy);
}

// Whether the factor knows all of its variables.
bool is_known(const Greedy& greedy, const Item& item) {
  return std::ranges::none_of(item.measurement.variables,
                              [&](Index j) { return greedy.unfactored[j]; });
}

// Its worth now; a guess by the factor before more is computed.
double reassess(Greedy& greedy, Index i) {
  Item& item = greedy.items[i];
  if (item.guessed < greedy.factors) return guess(greedy, item);
  if (item.tried) {
    update(greedy.knowledge, *item.tried);
  } else {
    item.tried = try_measurement(greedy.knowledge, item.measurement);
    greedy.tried.push_back(i);
  }
  return worth(greedy, item, estimated_gain(*item.tried));
}

// The best move by what it is worth now, -1 where nothing is left.
Index take_best(Greedy& greedy) {
  while (!greedy.waiting.empty()) {
    const Index i = greedy.waiting.top().item;
    greedy.waiting.pop();
    const Item& item = greedy.items[i];
    if (greedy.options.kept &&
        greedy.kept + static_cast<Index>(item.edges.size()) > *greedy.options.kept)
      continue;
    if (!is_known(greedy, item)) {
      greedy.after_factor.push_back(i);
      continue;
    }
    if (item.tried && item.tried->known == greedy.knowledge.added.size()) return i;
    greedy.waiting.push({reassess(greedy, i), i});
  }
  return -1;
}

void accept(Greedy& greedy, Index i) {
  Item item = std::move(greedy.items[i]);
  const elim::Wide increase = elim::add_factor(greedy.filled, factor_of(greedy, item.rows));
  add(greedy.knowledge, std::move(*item.tried));
  greedy.items[i].tried.reset();
  for (const Index e : item.rows) greedy.in.edge[e] = true;
  const bool brings = item.landmark >= 0;
  record(greedy, brings ? Move::Kind::landmark : Move::Kind::edge, std::move(item.edges), increase);
  if (!brings) return;
  const Index v = greedy.evidence.variable_vertex[item.landmark];
  greedy.in.vertex[v] = true;
  greedy.unfactored[item.landmark] = true;
  for (const Index e : greedy.edges_of[v]) {
    if (!greedy.is_candidate[e] || greedy.in.edge[e] || !all_in(greedy, e)) continue;
    greedy.after_factor.push_back(static_cast<Index>(greedy.items.size()));
    greedy.items.push_back(edge_item(greedy, e));
  }
}

bool is_over(const Greedy& greedy) {
  return greedy.options.ec && greedy.filled.ec > *greedy.options.ec;
}

bool is_reached(const Greedy& greedy) {
  return (greedy.options.sigma &&
          greedy.moves[greedy.settled - 1].sigma <= *greedy.options.sigma) ||
         (greedy.options.kept && greedy.kept >= *greedy.options.kept) ||
         (greedy.options.go_on && !greedy.options.go_on(greedy.kept));
}

void grow(Greedy& greedy) {
  while (!is_reached(greedy)) {
    const bool grown =
        elim::to_double(greedy.filled.ec) > growth * elim::to_double(greedy.fresh_ec);
    const bool over = is_over(greedy);
    if (grown || (over && greedy.filled.ec > greedy.fresh_ec)) {
      const elim::Wide before = greedy.filled.ec;
      renew_order(greedy);
      if (!over || elim::to_double(before) > worth_renewing * elim::to_double(greedy.filled.ec))
        continue;
    }
    if (over) return;
    if (greedy.knowledge.added_rows >= most_added) {
      renew_factor(greedy);
      continue;
    }
    const Index best = take_best(greedy);
    if (best >= 0) {
      accept(greedy, best);
    } else if (!greedy.after_factor.empty()) {
      renew_factor(greedy);
    } else {
      return;
    }
  }
}

// What is maximized, of all that is in.
double achieved(Greedy& greedy) {
  refactor(greedy);
  if (greedy.options.gain == GainKind::log_det)
    return solve::log_determinant(greedy.knowledge.factor);
  take_variances(greedy.knowledge);
  return -total_variance(greedy.knowledge);
}

Greedy make_greedy(const Choice& choice, const Evidence& evidence, const EcGreedyOptions& options) {
  Greedy greedy{choice,
                choice.graph,
                evidence,
                options,
                graph::transpose(choice.graph.edge_vertices, choice.graph.vertices()),
                std::vector<bool>(choice.graph.edges(), false),
                start_knowledge(evidence, options.seed)};
  for (const Index e : choice.candidates) greedy.is_candidate[e] = true;
  return greedy;
}

// Moves beyond the first that reaches a floor of sigma go.
void cut_at_sigma(const EcGreedyOptions& options, std::vector<Move>& moves) {
  if (!options.sigma) return;
  const auto reached =
      std::ranges::find_if(moves, [&](const Move& move) { return move.sigma <= *options.sigma; });
  if (reached != moves.end()) moves.erase(reached + 1, moves.end());
}

}  // namespace

std::string_view name(Move::Kind kind) {
  constexpr std::array names{"start", "edge", "landmark", "free"};
  return names[static_cast<std::size_t>(kind)];
}

std::vector<Move> ecgreedy(const Choice& choice, const Evidence& evidence,
                           const EcGreedyOptions& options) {
  Greedy greedy = make_greedy(choice, evidence, options);
  if (!start(greedy)) return {};
  take_variances(greedy.knowledge);
  std::vector<Index> first;
  for (const Index e : choice.candidates) {
    if (greedy.in.edge[e]) first.push_back(e);
  }
  record(greedy, Move::Kind::start, std::move(first), greedy.filled.ec);
  greedy.moves.back().sigma = mean_sigma(greedy.knowledge);
  greedy.settled = 1;
  if (!is_over(greedy) && !is_reached(greedy)) {
    offer_all(greedy);
    grow(greedy);
    settle_moves(greedy);
  }
  cut_at_sigma(options, greedy.moves);
  return std::move(greedy.moves);
}

std::optional<Move> free_edges(const Choice& choice, const Evidence& evidence,
                               std::span<const Move> moves, const EcGreedyOptions& options) {
  Greedy greedy = make_greedy(choice, evidence, options);
  greedy.in = selection(choice, kept_by(choice.candidates, moves));
  place_order(greedy);
  Move free{Move::Kind::free, {}, 0, 0, greedy.filled.ec, 0, moves.back().kept};
  for (const Index e : choice.candidates) {
    if (options.kept && free.kept == *options.kept) break;
    if (greedy.in.edge[e] || !all_in(greedy, e)) continue;
    if (elim::increase(greedy.filled, factor_of(greedy, std::span(&e, 1))) > 0) continue;
    free.edges.push_back(e);
    ++free.kept;
  }
  if (free.edges.empty()) return std::nullopt;
  const double before = achieved(greedy);
  for (const Index e : free.edges) greedy.in.edge[e] = true;
  free.gain = achieved(greedy) - before;
  free.sigma = mean_sigma(greedy.knowledge);
  std::vector<Move> all(moves.begin(), moves.end());
  all.push_back(free);
  const elim::Wide allowed = std::max(options.ec.value_or(0), free.ec);
  if (ec_after(choice, all, options) > allowed) return std::nullopt;
  return free;
}

std::vector<bool> kept_by(const std::vector<Index>& candidates, std::span<const Move> moves) {
  std::vector<Index> all;
  for (const Move& move : moves) all.insert(all.end(), move.edges.begin(), move.edges.end());
  std::ranges::sort(all);
  std::vector<bool> kept;
  for (const Index e : candidates) kept.push_back(std::ranges::binary_search(all, e));
  return kept;
}

std::optional<double> whole_sigma(const Choice& choice, const Evidence& evidence,
                                  const EcGreedyOptions& options) {
  Knowledge knowledge = start_knowledge(evidence, options.seed);
  const Selection all{std::vector<bool>(choice.graph.vertices(), true),
                      std::vector<bool>(choice.graph.edges(), true)};
  if (!refactor(knowledge, all, options.order(graph::graph_pattern(choice.graph))).empty())
    return std::nullopt;
  take_variances(knowledge);
  return mean_sigma(knowledge);
}

elim::Wide ec_after(const Choice& choice, std::span<const Move> moves,
                    const EcGreedyOptions& options) {
  const Selection in = selection(choice, kept_by(choice.candidates, moves));
  const graph::GraphPattern part = graph::graph_pattern(choice.graph, in.vertex, in.edge);
  return elim::elimination_complexity(part.pattern, options.order(part));
}

std::size_t moves_within(const Choice& choice, std::span<const Move> moves, elim::Wide ec,
                         const EcGreedyOptions& options) {
  std::size_t low = 1, high = moves.size();  // the last that fits is in [low, high]
  while (low < high) {
    const std::size_t middle = (low + high + 1) / 2;
    if (ec_after(choice, moves.first(middle), options) <= ec) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  return low;
}

}  // namespace sg::prune
