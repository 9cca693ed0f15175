#include "cmd/ecgreedy/budget.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/factor/initialize.h"
#include "lib/prune/exchange.h"
#include "lib/score/covariance.h"

namespace sg::ecgreedy {

elim::Wide rounded(double number) {
  return static_cast<elim::Wide>(std::min(std::round(number), 1e37));
}

elim::Wide part_of_ec(const Graph& graph, double part, const prune::EcGreedyOptions& greedy) {
  const graph::GraphPattern variables = graph::graph_pattern(graph);
  const elim::Wide whole = elim::elimination_complexity(variables.pattern, greedy.order(variables));
  return rounded(part * elim::to_double(whole));
}

std::vector<prune::Move> with_free(const prune::Choice& choice, const prune::Evidence& evidence,
                                   std::span<const prune::Move> moves,
                                   const prune::EcGreedyOptions& greedy) {
  std::vector<prune::Move> made(moves.begin(), moves.end());
  if (auto free = prune::free_edges(choice, evidence, moves, greedy))
    made.push_back(std::move(*free));
  return made;
}

Linearized linearized(const Graph& graph) {
  factor::Problem problem = factor::make_problem(graph);
  factor::Values values = factor::start_values(problem);
  prune::Evidence evidence = prune::measured_evidence(problem, values);
  return {std::move(problem), std::move(values), std::move(evidence)};
}

std::vector<bool> kept_within(const prune::Choice& choice, const prune::EcGreedyOptions& greedy) {
  const Linearized whole = linearized(choice.graph);
  std::vector<prune::Move> moves = prune::ecgreedy(choice, whole.evidence, greedy);
  if (moves.empty()) throw score::singular_error(whole.problem, whole.values);
  if (greedy.ec) moves.resize(prune::moves_within(choice, moves, *greedy.ec, greedy));
  return prune::kept_by(choice.candidates, with_free(choice, whole.evidence, moves, greedy));
}

}  // namespace sg::ecgreedy
