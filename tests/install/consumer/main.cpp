// consumer FILE: what the graph costs to eliminate in COLAMD's order, and whether a solver gets to its optimum.
#include <formats/formats.h>
#include <lib/elim/score.h>
#include <lib/factor/initialize.h>
#include <lib/order/order.h>
#include <lib/solve/batch.h>

#include <iostream>

int main(int, char** argv) {
  const sg::Graph graph = sg::formats::read_graph(argv[1]);
  const sg::graph::Pattern pattern = sg::graph::graph_pattern(graph).pattern;
  const sg::graph::Order order = sg::order::elimination_order("colamd", pattern);
  std::cout << sg::elim::to_string(sg::elim::elimination_complexity(pattern, order)) << '\n';

  const sg::factor::Problem problem = sg::factor::make_problem(graph);
  sg::factor::Values values = sg::factor::initial_values(problem);
  sg::factor::LinearSystem system = sg::factor::make_linear_system(problem);
  const auto solver = sg::solve::find_backend("cholmod").make(system, order, 1);
  const auto result = sg::solve::optimize(problem, system, solver, {}, values);
  std::cout << (result.converged ? "solved" : "not solved") << '\n';
}
