#include "lib/solve/places.h"

#include <array>

#include "lib/factor/gauge.h"
#include "lib/factor/linearize.h"
#include "lib/sparse/least_squares.h"

namespace sg::solve {
namespace {

// Not bearings, nor pixels.
bool measures_place(const factor::Problem& problem, Index e) {
  const graph::Space space = graph::row(problem.model[e]->type).measure.space;
  return graph::facts(space).translation.size > 0;
}

// Scalars of a step: their number among the unknown, -1 where they are none.
struct Unknowns {
  std::vector<Index> number;
  Index count = 0;
};
Unknowns unknown_places(const factor::Problem& problem, const std::vector<bool>& measured,
                        const std::vector<bool>& stays) {
  Unknowns result{std::vector<Index>(problem.step_at.back(), -1)};
  for (Index j = 0; j < problem.variables.pattern.variables(); ++j) {
    const Index v = problem.variables.variable_vertex[j];
    const graph::Axes axes = graph::facts(problem.space[v]).translation;
    for (int k = 0; k < axes.size && measured[v] && !stays[v]; ++k)
      result.number[problem.step_at[j] + axes.first + k] = result.count++;
  }
  return result;
}

void add_edge(const factor::Problem& problem, const factor::Values& values, Index e,
              const Unknowns& unknowns, sparse::LeastSquares& system) {
  std::array<double, factor::max_block> block;
  factor::linearize_row(problem, values, {}, e, block.data());
  const int height = factor::block_rows(problem, e);
  std::vector<sparse::Term> row;
  for (int i = 0; i < height; ++i) {
    row.clear();
    int at = i;
    for (Index j : problem.variables.pattern.rows[e]) {
      for (Index k = problem.step_at[j]; k < problem.step_at[j + 1]; ++k, at += height) {
        if (unknowns.number[k] >= 0 && block[at] != 0)
          row.push_back({unknowns.number[k], block[at]});
      }
    }
    add_square(system, 1, row, std::span(&block[at], 1));
  }
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
  sparse::LeastSquares system(unknowns.count, 1);
  for (Index e = 0; e < graph.edges(); ++e) {
    if (!left_out[e]) add_edge(problem, values, e, unknowns, system);
  }
  sparse::NormalFactor normal;
  factorize(system, normal);
  const std::vector<double> x = sparse::solve(normal, system.right);
  std::vector<double> step(unknowns.number.size(), 0);
  for (std::size_t k = 0; k < step.size(); ++k) {
    if (unknowns.number[k] >= 0) step[k] = x[unknowns.number[k]];
  }
  factor::retract(problem, step, values);
  for (Index v = 0; v < graph.vertices(); ++v) placed[v] = placed[v] || measured[v];
}

}  // namespace sg::solve
