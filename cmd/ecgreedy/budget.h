// Budgets of EC as sg-ecgreedy is told them.
#pragma once

#include <span>
#include <vector>

#include "lib/factor/problem.h"
#include "lib/prune/ecgreedy.h"

namespace sg::ecgreedy {

elim::Wide rounded(double number);
// This part of the EC of the whole graph, in the greedy's order.
elim::Wide part_of_ec(const Graph& graph, double part, const prune::EcGreedyOptions& greedy);

// The moves, and behind them what is free at their end.
std::vector<prune::Move> with_free(const prune::Choice& choice, const prune::Evidence& evidence,
                                   std::span<const prune::Move> moves,
                                   const prune::EcGreedyOptions& greedy);

// What the edges tell at the start of a solve, linearized there.
struct Linearized {
  factor::Problem problem;
  factor::Values values;
  prune::Evidence evidence;
};
Linearized linearized(const Graph& graph);

// Which candidates a call with this budget keeps, without exchange. Throws score::singular_error where the whole graph is.
std::vector<bool> kept_within(const prune::Choice& choice, const prune::EcGreedyOptions& greedy);

}  // namespace sg::ecgreedy
