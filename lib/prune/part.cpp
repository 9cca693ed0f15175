#include "lib/prune/part.h"

#include <algorithm>

#include "lib/order/order.h"

namespace sg::prune {

Part make_part(const Choice& choice, const Evidence& evidence, const EcGreedyOptions& options) {
  return {choice, evidence, options,
          start_knowledge(evidence, options.gain == GainKind::aligned, options.seed)};
}

void select(Part& part, const std::vector<bool>& kept) {
  part.in = selection(part.choice, kept);
  place_order(part);
}

namespace {

graph::GraphPattern variables_in(const Part& part) {
  return graph::graph_pattern(part.choice.graph, part.in.vertex, part.in.edge);
}

// All variables: those that are not in, and behind them `variables` in this order.
graph::Order order_of_all(const Part& part, const graph::GraphPattern& variables,
                          const graph::Order& order) {
  const Evidence& evidence = part.evidence;
  graph::Order all;
  for (Index j = 0; j < evidence.pattern.variables(); ++j) {
    if (!part.in.vertex[evidence.variable_vertex[j]]) all.push_back(j);
  }
  for (const Index k : order) all.push_back(evidence.vertex_variable[variables.variable_vertex[k]]);
  return all;
}

}  // namespace

void place_order(Part& part) {
  const Evidence& evidence = part.evidence;
  const graph::GraphPattern variables = variables_in(part);
  part.order = order_of_all(part, variables, part.options.order(variables));
  part.low.clear();
  const auto n = static_cast<Index>(part.order.size());
  const Index absent = n - variables.pattern.variables();
  part.position.resize(n);
  for (Index k = 0; k < n; ++k) part.position[part.order[k]] = k;
  graph::Pattern rows{evidence.pattern.dim, {}};
  for (Index e = 0; e < part.choice.graph.edges(); ++e) {
    if (part.in.edge[e]) rows.rows.add(evidence.pattern.rows[e]);
  }
  part.filled = elim::filled_graph(elim::ordered(rows, part.order), absent);
  part.fresh_ec = part.filled.ec;
}

std::vector<Index> refactor(Part& part) {
  if (part.low.empty()) {
    const graph::GraphPattern variables = variables_in(part);
    part.low = order_of_all(part, variables, order::elimination_order("metis", variables.pattern));
  }
  return refactor(part.knowledge, part.in, part.low);
}

std::vector<Index> factor_of(const Part& part, std::span<const Index> rows) {
  std::vector<Index> factor;
  for (const Index r : rows) {
    for (const Index j : part.evidence.pattern.rows[r]) factor.push_back(part.position[j]);
  }
  std::ranges::sort(factor);
  factor.erase(std::unique(factor.begin(), factor.end()), factor.end());
  return factor;
}

bool all_in(const Part& part, Index e) {
  return std::ranges::all_of(part.choice.graph.edge(e), [&](Index v) { return part.in.vertex[v]; });
}

double achieved(Part& part) {
  if (part.options.gain == GainKind::log_det) return solve::log_determinant(part.knowledge.factor);
  return -total_variance(part.knowledge);
}

double chosen(const Part& part, const Gain& gain) {
  return part.options.gain == GainKind::log_det ? gain.log_det : gain.trace;
}

std::optional<double> whole_sigma(const Choice& choice, const Evidence& evidence,
                                  const EcGreedyOptions& options) {
  Knowledge knowledge = start_knowledge(evidence, false, options.seed);
  const Selection all{std::vector<bool>(choice.graph.vertices(), true),
                      std::vector<bool>(choice.graph.edges(), true)};
  if (!refactor(knowledge, all, options.order(graph::graph_pattern(choice.graph))).empty())
    return std::nullopt;
  take_variances(knowledge);
  return mean_sigma(knowledge);
}

}  // namespace sg::prune
