#include "cmd/convert/hessian.h"

#include <numeric>

#include "lib/factor/initialize.h"
#include "lib/factor/linearize.h"
#include "lib/solve/normal_equations.h"
#include "lib/text/words.h"

namespace sg::convert {
namespace {

solve::NormalEquations normal_equations(const Graph& graph) {
  factor::Problem problem = factor::make_problem(graph);
  const factor::Values values = factor::start_values(problem);
  problem.held = -1;  // the gauge's row is the solvers', not the graph's
  problem.variables = graph::graph_pattern(graph);
  const factor::LinearSystem system = factor::linearized(problem, values);
  graph::Order order(problem.variables.pattern.variables());
  std::iota(order.begin(), order.end(), 0);
  solve::NormalEquations normal = solve::normal_structure(system, order);
  solve::form_normal_equations(system, {}, normal);
  return normal;
}

}  // namespace

void write_hessian(const Graph& graph, formats::Sink& sink) {
  const solve::NormalEquations normal = normal_equations(graph);
  const std::string n = std::to_string(normal.scalars());
  sink.write("%%MatrixMarket matrix coordinate real symmetric\n");
  sink.write("% A^T A at the estimates: the dimensions of the variables, by ascending id\n");
  sink.write(n + " " + n + " " + std::to_string(normal.rows.size()) + "\n");
  std::string line;
  for (int j = 0; j < normal.scalars();
       ++j) {  // a column of the upper triangle, a row of the lower
    for (int k = normal.column_begin[j]; k < normal.column_begin[j + 1]; ++k) {
      line = std::to_string(j + 1);
      text::append_number(line, normal.rows[k] + 1);
      text::append_number(line, normal.numbers[k]);
      sink.write(line += '\n');
    }
  }
}

}  // namespace sg::convert
