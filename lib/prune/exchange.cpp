#include "lib/prune/exchange.h"

#include <algorithm>
#include <cmath>

#include "lib/elim/row_price.h"
#include "lib/prune/ecgreedy.h"
#include "lib/prune/offer.h"

namespace sg::prune {
namespace {

constexpr double first_share = 0.12;  // of EC that is freed
constexpr double least_share = 0.01;
constexpr int most_rounds = 8;
constexpr Index spare = 3;        // observations that a landmark keeps, at least, when one goes
constexpr std::size_t tall = 48;  // rows of a landmark that are still weighed against each other

struct Outgoing {
  std::vector<Index> edges;  // candidates
  double value;              // loss per EC and cost of edges
  double price;              // in EC
};

// Of every edge that is in: by how much EC falls without it.
std::vector<double> prices(const Part& part) {
  const std::vector<elim::Wide> by_row = elim::row_prices(part.knowledge.pattern, part.order);
  std::vector<double> result(part.choice.graph.edges(), 0);
  std::size_t row = 0;
  for (Index e = 0; e < part.choice.graph.edges(); ++e) {
    if (part.in.edge[e]) result[e] = elim::to_double(by_row[row++]);
  }
  return result;
}

// What would be lost with rows that say this.
double loss(Part& part, const Measurement& measurement) {
  if (measurement.jacobian.rows() == 0) return 0;  // they say nothing of anything else
  return chosen(part, estimated_loss(try_measurement(part.knowledge, measurement)));
}

// All that could go from what is factored, the least worth first.
std::vector<Outgoing> outgoing(Part& part) {
  const Graph& graph = part.choice.graph;
  const std::vector<double> price = prices(part);
  std::vector<Outgoing> result;
  const auto weigh = [&](std::vector<Index> edges, const Measurement& measurement, double freed) {
    const double lost = loss(part, measurement);
    if (!std::isfinite(lost)) return;
    const auto cost = elim::to_double(edge_cost * edges.size());
    result.push_back({std::move(edges), lost / (freed + cost), freed});
  };
  std::vector<std::vector<Index>> seen_by(graph.vertices());  // candidates that are in
  for (const Index e : part.choice.candidates) {
    if (!part.in.edge[e]) continue;
    weigh({e}, measurement(part.evidence, e), price[e]);
    for (const Index v : graph.edge(e)) {
      if (graph.role(v) == graph::Role::landmark) seen_by[v].push_back(e);
    }
  }
  for (Index v = 0; v < graph.vertices(); ++v) {
    const Index j = part.evidence.vertex_variable[v];
    if (seen_by[v].empty() || j < 0 || seen_by[v].size() > tall) continue;
    const std::int64_t own = part.filled.dim[part.position[j]],
                       all = part.filled.count[part.position[j]];
    double freed = elim::to_double(elim::elimination_cost(own, all));
    for (const Index e : seen_by[v]) freed += price[e];
    weigh(seen_by[v], without(part.evidence, seen_by[v], j), freed);
  }
  std::ranges::stable_sort(result, {}, &Outgoing::value);
  return result;
}

// The least worth, until this much of EC is free. Landmarks that stay keep what determines them.
std::vector<Index> least(const Part& part, std::span<const Outgoing> outgoing, double freed) {
  const Graph& graph = part.choice.graph;
  std::vector<Index> left(graph.vertices(), 0);  // edges that are in
  for (Index e = 0; e < graph.edges(); ++e) {
    for (const Index v : graph.edge(e)) left[v] += part.in.edge[e];
  }
  const auto needs = [&](Index v) {
    return graph.role(v) == graph::Role::landmark &&
           left[v] <= std::max(spare, part.choice.min_obs);
  };
  std::vector<bool> gone(graph.edges(), false);
  std::vector<Index> result;
  double sum = 0;
  for (const Outgoing& out : outgoing) {
    if (sum >= freed) break;
    if (std::ranges::any_of(out.edges, [&](Index e) { return gone[e]; })) continue;
    if (out.edges.size() == 1 && std::ranges::any_of(graph.edge(out.edges.front()), needs))
      continue;
    for (const Index e : out.edges) {
      gone[e] = true;
      for (const Index v : graph.edge(e)) --left[v];
    }
    result.insert(result.end(), out.edges.begin(), out.edges.end());
    sum += out.price;
  }
  return result;
}

// What these moves' selection achieves, factored; nothing where something is undetermined.
std::optional<double> take(Part& part, std::span<const Move> moves) {
  select(part, kept_by(part.choice.candidates, moves));
  if (!refactor(part).empty()) return std::nullopt;
  take_variances(part.knowledge);
  return achieved(part);
}

// What these edges gain in a selection that they are not in yet, and its sigma with them.
void tell(Part& part, Move& free) {
  const auto now = [&] {
    refactor(part);
    take_variances(part.knowledge);
    return achieved(part);
  };
  const double before = now();
  for (const Index e : free.edges) part.in.edge[e] = true;
  free.gain = now() - before;
  free.sigma = mean_sigma(part.knowledge);
}

}  // namespace

std::vector<Move> exchanged(const Choice& choice, const Evidence& evidence,
                            const EcGreedyOptions& options, std::vector<Move> moves) {
  Part part = make_part(choice, evidence, options);
  const bool all_kept = moves.back().kept == static_cast<Index>(choice.candidates.size());
  if (moves.size() < 2 || all_kept) return moves;
  std::optional<double> best = take(part, moves);
  EcGreedyOptions again = options;  // with other random vectors
  double share = first_share;
  for (int round = 0; best && round < most_rounds && share > least_share; ++round) {
    if (options.go_on && !options.go_on(moves.back().kept)) break;
    ++again.seed;
    std::vector<Index> out = least(part, outgoing(part), share * elim::to_double(part.filled.ec));
    const Index kept = moves.back().kept - static_cast<Index>(out.size());
    std::vector<Move> trial = moves;
    trial.push_back({Move::Kind::drop, std::move(out), 0, 0, 0, 0, kept});
    trial = ecgreedy_from(choice, evidence, again, std::move(trial), *best);
    if (!trial.empty()) {
      const std::size_t within =
          moves_within(choice, trial, *options.ec, options, moves.size() + 1);
      trial.erase(trial.begin() + static_cast<std::ptrdiff_t>(within), trial.end());
      const std::optional<double> value = take(part, trial);
      if (value && *value > *best) {
        best = value;
        moves = std::move(trial);
        continue;
      }
    }
    share /= 2;
    best = take(part, moves);
  }
  return moves;
}

std::optional<Move> free_edges(const Choice& choice, const Evidence& evidence,
                               std::span<const Move> moves, const EcGreedyOptions& options) {
  Part part = make_part(choice, evidence, options);
  select(part, kept_by(choice.candidates, moves));
  Move free{Move::Kind::free, {}, 0, 0, part.filled.ec, 0, moves.back().kept};
  for (const Index e : choice.candidates) {
    if (options.kept && free.kept == *options.kept) break;
    if (part.in.edge[e] || !all_in(part, e)) continue;
    if (elim::increase(part.filled, factor_of(part, std::span(&e, 1))) > 0) continue;
    free.edges.push_back(e);
    ++free.kept;
  }
  if (free.edges.empty()) return std::nullopt;
  if (options.told) tell(part, free);
  std::vector<Move> all(moves.begin(), moves.end());
  all.push_back(free);
  const elim::Wide allowed = std::max(options.ec.value_or(0), free.ec);
  if (ec_after(choice, all, options) > allowed) return std::nullopt;
  return free;
}

}  // namespace sg::prune
