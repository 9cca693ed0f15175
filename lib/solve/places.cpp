#include "lib/solve/places.h"

#include <Eigen/Core>
#include <array>

#include "lib/factor/gauge.h"
#include "lib/factor/linearize.h"
#include "lib/solve/least_squares.h"

namespace sg::solve {
namespace {

// Not bearings, nor pixels.
bool measures_place(const factor::Problem& problem, Index e) {
  const graph::Space space = graph::row(problem.model[e]->type).measure.space;
  return graph::facts(space).translation.size > 0;
}

// Of every variable, its place among those whose translation is unknown, -1 where it is not; and their dimensions.
struct Unknowns {
  std::vector<Index> number;
  std::vector<int> dim;
};
graph::Axes axes(const factor::Problem& problem, Index j) {
  return graph::facts(problem.space[problem.variables.variable_vertex[j]]).translation;
}
Unknowns unknown_places(const factor::Problem& problem, const std::vector<bool>& measured,
                        const std::vector<bool>& stays) {
  Unknowns result;
  for (Index j = 0; j < problem.variables.pattern.variables(); ++j) {
    const Index v = problem.variables.variable_vertex[j];
    const bool unknown = measured[v] && !stays[v] && axes(problem, j).size > 0;
    result.number.push_back(unknown ? static_cast<Index>(result.dim.size()) : -1);
    if (unknown) result.dim.push_back(axes(problem, j).size);
  }
  return result;
}

void add_edge(const factor::Problem& problem, const factor::Values& values, Index e,
              const Unknowns& unknowns, LeastSquares& system) {
  std::array<double, factor::max_block> block;
  factor::linearize_row(problem, values, {}, e, block.data());
  const int height = factor::block_rows(problem, e);
  Eigen::Map<Eigen::MatrixXd> numbers(block.data(), height,
                                      factor::block_columns(problem.variables.pattern, e));
  std::vector<Index> variables;
  Eigen::Index from = 0, to = 0;  // columns; those that count are moved together
  for (const Index j : problem.variables.pattern.rows[e]) {
    if (unknowns.number[j] >= 0) {
      const auto [first, size] = axes(problem, j);
      variables.push_back(unknowns.number[j]);
      for (int k = 0; k < size; ++k) numbers.col(to++) = numbers.col(from + first + k);
    }
    from += problem.variables.pattern.dim[j];
  }
  if (!variables.empty()) add_row(system, variables, numbers.leftCols(to), numbers.col(from));
}

}  // namespace

void solve_places(const factor::Problem& problem, std::vector<bool>& placed,
                  factor::Values& values) {
  const Graph& graph = *problem.graph;
  std::vector<bool> left_out(graph.edges()), measured(graph.vertices(), false);
  for (Index e = 0; e < graph.edges(); ++e) {
    left_out[e] = !measures_place(problem, e);
    for (Index v : graph.edge(e)) measured[v] = measured[v] || !left_out[e];
  }
  const Unknowns unknowns = unknown_places(problem, measured, factor::anchors(problem, left_out));
  LeastSquares system = make_least_squares(unknowns.dim, 1);
  for (Index e = 0; e < graph.edges(); ++e) {
    if (!left_out[e]) add_edge(problem, values, e, unknowns, system);
  }
  Elimination elimination = plan_elimination(system);
  eliminate(system, {}, elimination);
  const Triangle factor = triangle(elimination);
  Rows x = right_side(system, factor);
  solve(factor, 1, x);
  std::vector<double> step(static_cast<std::size_t>(problem.step_at.back()), 0);
  for (std::size_t j = 0; j < unknowns.number.size(); ++j) {
    const Index number = unknowns.number[j];
    if (number < 0) continue;
    const graph::Axes own = axes(problem, static_cast<Index>(j));
    for (int k = 0; k < own.size; ++k)
      step[problem.step_at[j] + own.first + k] = x(factor.row(number) + k, 0);
  }
  factor::retract(problem, step, values);
  for (Index v = 0; v < graph.vertices(); ++v) placed[v] = placed[v] || measured[v];
}

}  // namespace sg::solve
