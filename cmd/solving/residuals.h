// The table of sg-solve --residuals and --weights: a row an edge, the worst first.
#pragma once

#include "cmd/common/table.h"
#include "lib/factor/residuals.h"

namespace sg::solving {

struct ResidualRow {
  const Graph& graph;
  factor::Residual residual;
  double weight;
  std::size_t line;
};
extern const std::vector<cmd::Column<ResidualRow>> residual_columns;

void print_residuals(const factor::Problem& problem, const factor::Values& values,
                     const factor::Loss& loss, cmd::Table<ResidualRow>& table);

}  // namespace sg::solving
