#include "lib/marginalize/exchange.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "lib/graph/components.h"
#include "lib/marginalize/errors.h"
#include "lib/order/order.h"

namespace sg::marginalize {
namespace {

constexpr double less = 0.25, more = 2;  // of the moves, after a turn that lost and one that gained
constexpr double fewest = 0.02;
constexpr int few_steps = 3, most_steps = 30;  // of fitting, within a turn and at last
constexpr double gap = 0.02;                   // that fitting may leave, in nats
constexpr double factor_cost = 100;            // of any, beside elimination
constexpr double next_to_nothing = 1e-9;       // of what a measurement could say

// Which vertices stand in one rigid body: of landmarks those that something places. The last stands for the world.
struct Bodies {
  const At& at;
  graph::DisjointSets parts;
  std::vector<bool> placed;  // landmarks

  explicit Bodies(const At& where)
      : at(where),
        parts(where.problem.graph->vertices() + 1),
        placed(where.problem.graph->vertices(), false) {}
};

Index world(const Bodies& bodies) {
  return bodies.at.problem.graph->vertices();
}
bool is_pose(const Bodies& bodies, Index v) {
  return bodies.at.problem.graph->role(v) == graph::Role::pose;
}
// Of a pose and a landmark: one tells where the landmark is beside the pose, not where the pose is.
bool places_landmark(const Bodies& bodies, const Measurable& of) {
  return of.second >= 0 && is_pose(bodies, of.first) && !is_pose(bodies, of.second);
}
// Whether it makes one body of two.
bool joins(Bodies& bodies, const Measurable& of) {
  const Index other = of.second < 0 ? world(bodies) : of.second;
  if (!places_landmark(bodies, of)) return join(bodies.parts, of.first, other);
  if (bodies.placed[of.second]) return false;
  bodies.placed[of.second] = true;
  return join(bodies.parts, of.first, of.second);
}
bool is_within(Bodies& bodies, const Measurable& of) {
  return find(bodies.parts, of.first) ==
         find(bodies.parts, of.second < 0 ? world(bodies) : of.second);
}

// Marks those that hold together what is recovered: taken ones by descending worth, poses first. Edges that stay do not
// count. They may hold as well, but cannot have an error: without it, what is owed on one side could not be brought.
std::vector<bool> indispensable(const Whole& whole, const std::vector<Offer>& offers,
                                std::span<const Index> by_worth, Bodies& bodies) {
  const Graph& graph = *whole.at.problem.graph;
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (graph.fixed[v]) join(bodies.parts, v, world(bodies));
  }
  std::vector<bool> result(offers.size(), false);
  for (const bool landmarks : {false, true}) {
    for (const Index k : by_worth) {
      const Measurable& of = offers[k].of;
      if (offers[k].taken && places_landmark(bodies, of) == landmarks && joins(bodies, of))
        result[k] = true;
    }
  }
  return result;
}

// All that gain, those that gain most first.
std::vector<Move> moves(const Whole& whole, double rate, const Exchange& exchange, Rest& all) {
  const std::vector<Offer>& offers = exchange.offers;
  std::vector<double> worth = worths(offers, all);
  for (std::size_t k = 0; k < worth.size(); ++k) worth[k] += exchange.strain[k];
  std::vector<Index> by_worth(offers.size());
  std::iota(by_worth.begin(), by_worth.end(), 0);
  std::ranges::stable_sort(by_worth, std::greater(), [&](Index k) { return worth[k]; });
  Bodies bodies(whole.at);
  const std::vector<bool> stays = indispensable(whole, offers, by_worth, bodies);

  graph::Lists<> factors;
  for (std::size_t k = 0; k < offers.size(); ++k) {
    if (stays[k]) factors.add(ends_of(offers[k].of));
  }
  graph::GraphPattern least =
      pattern_left(*whole.at.problem.graph, whole.removed, whole.edge_gone, factors);
  Prices sheet = prices(least, exchange.order, whole.removed, rate);
  const auto cost = [&](Index k) {
    return rate * (elim::to_double(price(sheet, offers[k].of)) + factor_cost);
  };
  std::vector<Move> result;
  for (const Index k : by_worth) {
    if (!offers[k].taken || stays[k]) continue;
    const double gain = cost(k) - worth[k];
    pay(sheet, offers[k].of);
    if (gain > 0 && is_within(bodies, offers[k].of)) result.push_back({k, gain});
  }
  for (const Index k : by_worth) {
    if (offers[k].taken) continue;
    const double gain = worth[k] - cost(k);
    if (gain > 0) result.push_back({k, gain});
  }
  std::ranges::stable_sort(result, std::greater(), &Move::gain);
  return result;
}

// Makes this part of the moves that share no vertex, those that gain most; returns how many.
std::size_t make(std::span<const Move> moves, double part, const Graph& graph,
                 std::vector<Offer>& offers) {
  std::vector<bool> touched(graph.vertices(), false);
  std::vector<Move> apart;
  for (const Move& move : moves) {
    const std::vector<Index> ends = ends_of(offers[move.offer].of);
    if (std::ranges::any_of(ends, [&](Index v) { return touched[v]; })) continue;
    for (const Index v : ends) touched[v] = true;
    apart.push_back(move);
  }
  apart.resize(static_cast<std::size_t>(std::ceil(part * static_cast<double>(apart.size()))));
  for (const Move& move : apart) {
    Offer& offer = offers[move.offer];
    offer.taken = !offer.taken;
    const auto d = offer.truth.rows();
    if (offer.taken)
      offer.information =
          next_to_nothing * offer.truth.llt().solve(Eigen::MatrixXd::Identity(d, d));
  }
  return apart.size();
}

// Of every offer, 0 of those that are not taken.
std::vector<double> strains(const Whole& whole, const Eigen::VectorXd& owed,
                            const std::vector<Offer>& offers) {
  std::vector<Spring> springs;
  for (const Offer& offer : offers) {
    if (offer.taken) springs.push_back({offer.of, offer.slope, offer.information});
  }
  const std::vector<double> of_taken = strains(whole.at, owed, springs);
  std::vector<double> result(offers.size(), 0);
  std::size_t next = 0;
  for (std::size_t k = 0; k < offers.size(); ++k) {
    if (offers[k].taken) result[k] = of_taken[next++];
  }
  return result;
}

// Fits what is taken, and shows it; returns what it loses and costs, infinite where it is not determined.
double show(const Terms& terms, int steps, Exchange& exchange) {
  const graph::Pattern left = pattern_left(terms.whole, exchange.offers).pattern;
  exchange.order = order::elimination_order("wmf", left);
  const auto lost = fit(terms.whole, exchange.order, gap, steps, exchange.offers);
  if (!lost) return std::numeric_limits<double>::infinity();
  exchange.strain = strains(terms.whole, terms.owed, exchange.offers);
  const State state{exchange.offers,
                    elim::to_double(elim::elimination_complexity(left, exchange.order)), *lost,
                    std::accumulate(exchange.strain.begin(), exchange.strain.end(), 0.0)};
  terms.see(state);
  return state.lost + state.strain + terms.rate * state.ec;
}

}  // namespace

void advance(const Terms& terms, int turns, Rest& all, Exchange& exchange) {
  for (int turn = 0; turn < turns && !exchange.over; ++turn) {
    const double now = show(terms, few_steps, exchange);
    if (now < exchange.least) {
      exchange.least = now;
      exchange.best = exchange.offers;
      exchange.moves = moves(terms.whole, terms.rate, exchange, all);
      exchange.part = std::min(1.0, more * exchange.part);
    } else {
      exchange.offers = exchange.best;
      exchange.part *= less;
    }
    exchange.over =
        exchange.best.empty() || exchange.part < fewest ||
        make(exchange.moves, exchange.part, *terms.whole.at.problem.graph, exchange.offers) == 0;
  }
}

void settle(const Terms& terms, Exchange& exchange) {
  if (exchange.best.empty()) return;
  exchange.offers = std::move(exchange.best);
  show(terms, most_steps, exchange);
}

}  // namespace sg::marginalize
