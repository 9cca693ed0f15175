#include "cmd/ecgreedy/budget.h"

#include <algorithm>
#include <cmath>

#include "lib/prune/exchange.h"

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

}  // namespace sg::ecgreedy
