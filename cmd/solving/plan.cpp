#include "cmd/solving/plan.h"

namespace sg::solving {

solve::LinearSolver planned(const Plan& plan, const factor::Problem& problem,
                            const factor::LinearSystem& system) {
  graph::GraphPattern variables = problem.variables;
  graph::Lists<>& rows = variables.pattern.rows;
  if (problem.held >= 0) rows.begin.pop_back();  // the order is that without the gauge's row
  rows.items.resize(rows.begin.back());
  const graph::Order order = cmd::named_order(plan.method, *problem.graph, variables).order;
  return solve::find_backend(plan.backend).make(system, order, plan.threads);
}

std::vector<bool> moved(const factor::Problem& problem) {
  std::vector<bool> result(problem.graph->vertices(), false);
  for (std::size_t j = 0; j < problem.variables.variable_vertex.size(); ++j) {
    result[problem.variables.variable_vertex[j]] = !factor::is_held(problem, static_cast<Index>(j));
  }
  return result;
}

}  // namespace sg::solving
