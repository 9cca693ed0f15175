#include "lib/prune/ecgreedy.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "lib/prune/candidates.h"
#include "lib/prune/offer.h"
#include "lib/prune/settle.h"

namespace sg::prune {
namespace {

constexpr double growth = 1.25;          // of EC until the order is renewed
constexpr double worth_renewing = 1.01;  // at the end of a budget: what a new order has to win
constexpr std::int64_t most_stored = 1 << 23;  // numbers in roots (information_gain.h)
constexpr Index sparsest = 256;                // rate of a start, before none
constexpr double most_sigma = 1e5;             // of a start, in multiples of the whole graph's

// Rows until the factor is renewed, which takes the longer the larger the graph is; with what was added grows the time of a
// try.
Index most_added(const Part& part) {
  return std::clamp<Index>(part.evidence.poses / 50, 192, 640);
}

struct Waiting {
  double worth;  // as it was last
  Index offer;
  bool operator<(const Waiting& other) const {
    return worth != other.worth ? worth < other.worth : offer > other.offer;
  }
};

struct Greedy {
  Part part;
  graph::Lists<> edges_of;         // vertices
  std::vector<bool> is_candidate;  // edges
  int factors = 0;                 // made so far
  Index kept = 0;
  std::vector<bool> unfactored = {};  // variables that came in since the factor
  std::vector<Offer> offers = {};
  std::vector<int> guessed = {};  // the factor by which each offer's worth was guessed
  std::priority_queue<Waiting> waiting = {};
  std::vector<Index> tried = {};         // offers
  std::int64_t stored = 0;               // numbers of their roots
  std::vector<Index> after_factor = {};  // offers of variables that it does not know
  std::vector<Move> moves = {};
  std::size_t settled = 0;  // of the moves
};

void make_factor(Greedy& greedy) {
  greedy.unfactored.assign(greedy.part.evidence.variable_vertex.size(), false);
  ++greedy.factors;
  refactor(greedy.part);
}

// Where measurements hold the gauge, a selection without those may pass for determined by rounding alone: its sigma is
// beyond all measure then.
bool holds_gauge(Part& part) {
  if (part.evidence.held) return true;
  take_variances(part.knowledge);
  const auto whole = whole_sigma(part.choice, part.evidence, part.options);
  return whole && mean_sigma(part.knowledge) < most_sigma * *whole;
}

// Starts from these candidates without the landmarks that they leave undetermined. False where they leave another
// vertex so.
bool start_from(Part& part, std::vector<bool> kept) {
  while (true) {
    select(part, kept);
    const std::vector<Index> undetermined = refactor(part);
    if (undetermined.empty()) return holds_gauge(part);
    for (const Index j : undetermined) {
      const Index v = part.evidence.variable_vertex[j];
      if (part.choice.graph.role(v) != graph::Role::landmark || !leave_out(part.choice, v, kept))
        return false;
    }
  }
}

// False where all of the graph leaves something undetermined.
bool start(Part& part) {
  const Choice& choice = part.choice;
  const bool sees = std::ranges::any_of(choice.candidates, [&](Index e) {
    return graph::edge_role(choice.graph, choice.poses, e) == graph::EdgeRole::observation;
  });
  Index rate = sees ? start_rate : 0;
  for (; !start_from(part, sparse_start(choice, rate)); rate = rate == 0 ? 1 : rate / 2) {
    if (rate == 1) return false;
  }
  const auto& most = part.options.start_ec;
  while (most && part.filled.ec > *most && rate > 1) {
    const Index sparser = rate < sparsest ? 2 * rate : 0;
    if (!start_from(part, sparse_start(choice, sparser))) {
      start_from(part, sparse_start(choice, rate));
      return true;
    }
    rate = sparser;
  }
  return true;
}

void add_offer(Greedy& greedy, Offer offer) {
  greedy.offers.push_back(std::move(offer));
  greedy.guessed.push_back(greedy.factors);
}

void wait(Greedy& greedy, Offer offer, double value) {
  greedy.waiting.push({value, static_cast<Index>(greedy.offers.size())});
  add_offer(greedy, std::move(offer));
}

void offer_landmark(Greedy& greedy, Index vertex) {
  if (greedy.part.evidence.vertex_variable[vertex] < 0) return;
  std::vector<Index> candidates, others;
  for (const Index e : greedy.edges_of[vertex]) {
    const bool alone = std::ranges::all_of(greedy.part.choice.graph.edge(e), [&](Index v) {
      return v == vertex || greedy.part.in.vertex[v];
    });
    if (alone) (greedy.is_candidate[e] ? candidates : others).push_back(e);
  }
  if (auto best = landmark_offer(greedy.part, vertex, std::move(candidates), others))
    wait(greedy, std::move(best->offer), best->worth);
}

// All moves that there are now.
void offer_all(Greedy& greedy) {
  Part& part = greedy.part;
  greedy.waiting = {};
  greedy.offers.clear();
  greedy.guessed.clear();
  greedy.tried.clear();
  greedy.stored = 0;
  greedy.after_factor.clear();
  for (const Index e : part.choice.candidates) {
    if (part.in.edge[e] || !all_in(part, e)) continue;
    Offer offer = edge_offer(part, e);
    const double value = guessed_worth(part, offer);
    wait(greedy, std::move(offer), value);
  }
  for (Index v = 0; v < part.choice.graph.vertices(); ++v) {
    if (!part.in.vertex[v]) offer_landmark(greedy, v);
  }
}

// Its gain and sigma are told when it is settled.
void record(Greedy& greedy, Move::Kind kind, std::vector<Index> edges, elim::Wide increase) {
  greedy.kept += static_cast<Index>(edges.size());
  greedy.moves.push_back(
      {kind, std::move(edges), 0, increase, greedy.part.filled.ec, 0, greedy.kept});
}

bool is_told(const EcGreedyOptions& options) {
  return options.told || options.sigma;
}

// What the moves since the factor have gained.
void settle_moves(Greedy& greedy) {
  if (!is_told(greedy.part.options)) {
    greedy.settled = greedy.moves.size();
    return;
  }
  for (const Settled& settled : settle(greedy.part.knowledge)) {
    Move& move = greedy.moves[greedy.settled++];
    move.gain = chosen(greedy.part, settled.gain);
    move.sigma = settled.mean_sigma;
  }
}

// They are tried again before they are believed.
void forget_tried(Greedy& greedy) {
  for (const Index i : greedy.tried) greedy.offers[i].tried.reset();
  greedy.tried.clear();
  greedy.stored = 0;
}

// A factor of all that is in, in the same order.
void renew_factor(Greedy& greedy) {
  settle_moves(greedy);
  make_factor(greedy);
  forget_tried(greedy);
  for (const Index i : greedy.after_factor) greedy.waiting.push({HUGE_VAL, i});
  greedy.after_factor.clear();
}

// A new order.
void renew_order(Greedy& greedy) {
  settle_moves(greedy);
  place_order(greedy.part);
  make_factor(greedy);
  if (is_told(greedy.part.options)) take_variances(greedy.part.knowledge);
  offer_all(greedy);
}

// Whether the factor knows all of its variables.
bool is_known(const Greedy& greedy, const Offer& offer) {
  return std::ranges::none_of(offer.measurement.variables,
                              [&](Index j) { return greedy.unfactored[j]; });
}

// Its worth now; a guess by the factor before more is computed.
double reassess(Greedy& greedy, Index i) {
  Offer& offer = greedy.offers[i];
  if (greedy.guessed[i] < greedy.factors) {
    greedy.guessed[i] = greedy.factors;
    return guessed_worth(greedy.part, offer);
  }
  if (offer.tried) {
    update(greedy.part.knowledge, *offer.tried);
  } else {
    if (greedy.stored > most_stored) forget_tried(greedy);
    offer.tried = try_measurement(greedy.part.knowledge, offer.measurement);
    greedy.stored += offer.tried->root.size();
    greedy.tried.push_back(i);
  }
  return worth(greedy.part, offer, estimated_gain(*offer.tried));
}

// The best move by what it is worth now, -1 where nothing is left.
Index take_best(Greedy& greedy) {
  const auto& most = greedy.part.options.kept;
  while (!greedy.waiting.empty()) {
    const Index i = greedy.waiting.top().offer;
    greedy.waiting.pop();
    const Offer& offer = greedy.offers[i];
    if (most && greedy.kept + static_cast<Index>(offer.edges.size()) > *most) continue;
    if (!is_known(greedy, offer)) {
      greedy.after_factor.push_back(i);
      continue;
    }
    if (offer.tried && offer.tried->known == greedy.part.knowledge.added.size()) return i;
    greedy.waiting.push({reassess(greedy, i), i});
  }
  return -1;
}

void accept(Greedy& greedy, Index i) {
  Part& part = greedy.part;
  Offer offer = std::move(greedy.offers[i]);
  const elim::Wide increase = elim::add_factor(part.filled, factor_of(part, offer.rows));
  add(part.knowledge, std::move(*offer.tried));
  greedy.offers[i].tried.reset();
  for (const Index e : offer.rows) part.in.edge[e] = true;
  const bool brings = offer.landmark >= 0;
  record(greedy, brings ? Move::Kind::landmark : Move::Kind::edge, std::move(offer.edges),
         increase);
  if (!brings) return;
  const Index v = part.evidence.variable_vertex[offer.landmark];
  part.in.vertex[v] = true;
  greedy.unfactored[offer.landmark] = true;
  for (const Index e : greedy.edges_of[v]) {
    if (!greedy.is_candidate[e] || part.in.edge[e] || !all_in(part, e)) continue;
    greedy.after_factor.push_back(static_cast<Index>(greedy.offers.size()));
    add_offer(greedy, edge_offer(part, e));
    greedy.guessed.back() = -1;
  }
}

bool is_over(const Part& part) {
  return part.options.ec && part.filled.ec > *part.options.ec;
}

bool is_reached(const Greedy& greedy) {
  const EcGreedyOptions& options = greedy.part.options;
  return (options.sigma && greedy.moves[greedy.settled - 1].sigma <= *options.sigma) ||
         (options.kept && greedy.kept >= *options.kept) ||
         (options.go_on && !options.go_on(greedy.kept));
}

// Moves until one of the budgets is reached.
void grow(Greedy& greedy) {
  Part& part = greedy.part;
  while (!is_reached(greedy)) {
    const bool grown = elim::to_double(part.filled.ec) > growth * elim::to_double(part.fresh_ec);
    const bool over = is_over(part);
    if (grown || (over && part.filled.ec > part.fresh_ec)) {
      const elim::Wide before = part.filled.ec;
      renew_order(greedy);
      if (!over || elim::to_double(before) > worth_renewing * elim::to_double(part.filled.ec))
        continue;
    }
    if (over) return;
    if (part.knowledge.added_rows >= most_added(part)) {
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

Greedy make_greedy(const Choice& choice, const Evidence& evidence, const EcGreedyOptions& options) {
  Greedy greedy{make_part(choice, evidence, options),
                graph::transpose(choice.graph.edge_vertices, choice.graph.vertices()),
                std::vector<bool>(choice.graph.edges(), false)};
  for (const Index e : choice.candidates) greedy.is_candidate[e] = true;
  greedy.unfactored.assign(evidence.variable_vertex.size(), false);
  return greedy;
}

// Moves beyond the first that reaches a floor of sigma go.
void cut_at_sigma(const EcGreedyOptions& options, std::vector<Move>& moves) {
  if (!options.sigma) return;
  const auto reached =
      std::ranges::find_if(moves, [&](const Move& move) { return move.sigma <= *options.sigma; });
  if (reached != moves.end()) moves.erase(reached + 1, moves.end());
}

// All that is in being factored, its variances taken, and the moves told of.
std::vector<Move> grown(Greedy& greedy) {
  greedy.settled = greedy.moves.size();
  if (!is_over(greedy.part) && !is_reached(greedy)) {
    offer_all(greedy);
    grow(greedy);
    settle_moves(greedy);
  }
  cut_at_sigma(greedy.part.options, greedy.moves);
  return std::move(greedy.moves);
}

}  // namespace

std::vector<Move> ecgreedy(const Choice& choice, const Evidence& evidence,
                           const EcGreedyOptions& options) {
  Greedy greedy = make_greedy(choice, evidence, options);
  if (!start(greedy.part)) return {};
  take_variances(greedy.part.knowledge);
  std::vector<Index> first;
  for (const Index e : choice.candidates) {
    if (greedy.part.in.edge[e]) first.push_back(e);
  }
  record(greedy, Move::Kind::start, std::move(first), greedy.part.filled.ec);
  greedy.moves.back().sigma = mean_sigma(greedy.part.knowledge);
  return grown(greedy);
}

std::vector<Move> ecgreedy_from(const Choice& choice, const Evidence& evidence,
                                const EcGreedyOptions& options, std::vector<Move> moves,
                                double before) {
  Greedy greedy = make_greedy(choice, evidence, options);
  Part& part = greedy.part;
  select(part, kept_by(choice.candidates, moves));
  if (!refactor(part).empty()) return {};
  take_variances(part.knowledge);
  Move& last = moves.back();
  last.gain = achieved(part) - before;
  last.ec = part.filled.ec;
  last.sigma = mean_sigma(part.knowledge);
  greedy.kept = last.kept;
  greedy.moves = std::move(moves);
  return grown(greedy);
}

}  // namespace sg::prune
