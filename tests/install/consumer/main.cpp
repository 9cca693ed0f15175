// consumer FILE: what the graph costs to eliminate in COLAMD's order, and whether a solver gets to its optimum.
#include <formats/formats.h>
#include <lib/elim/score.h>
#include <lib/factor/initialize.h>
#include <lib/order/order.h>
#include <lib/solve/batch.h>

#include <iostream>

int main(int, char** argv) {
  const sg::Graph graph = sg::read_graph(argv[1]);
  const sg::Pattern pattern = sg::graph_pattern(graph).pattern;
  const sg::Order order = sg::elimination_order("colamd", pattern);
  std::cout << sg::to_string(sg::elimination_complexity(pattern, order)) << '\n';

  const sg::Problem problem = sg::make_problem(graph);
  sg::Values values = sg::initial_values(problem);
  sg::LinearSystem system = sg::make_linear_system(problem);
  const auto solver = sg::find_backend("cholmod").make(system, order, 1);
  const auto result = sg::optimize(problem, system, solver, {}, values);
  std::cout << (result.converged ? "solved" : "not solved") << '\n';
}
