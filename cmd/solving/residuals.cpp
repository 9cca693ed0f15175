#include "cmd/solving/residuals.h"

#include <algorithm>

namespace sg::solving {
namespace {

cmd::IdList ids(const ResidualRow& row) {
  cmd::IdList result;
  for (const Index v : row.graph.edge(row.residual.edge)) result.push_back(row.graph.id[v]);
  return result;
}

// Of every edge, whose lines ascend: one pass over the text.
std::vector<std::size_t> line_numbers(const Graph& graph) {
  std::vector<std::size_t> result;
  std::size_t number = 1;
  Offset at = 0;
  const std::string_view text = graph.text.view;
  for (const Offset line : graph.edge_line) {
    number += std::count(text.begin() + at, text.begin() + line, '\n');
    at = line;
    result.push_back(number);
  }
  return result;
}

}  // namespace

const std::vector<cmd::Column<ResidualRow>> residual_columns{
    {"line", "Of the edge in the file", &ResidualRow::line},
    {"type", "Its tag",
     [](ResidualRow& row) { return row.graph.type_of_edge(row.residual.edge).tag; }},
    {"ids", "Its vertices", [](ResidualRow& row) { return ids(row); }},
    {"chi2", "Its chi-square", [](ResidualRow& row) { return row.residual.chi2; }},
    {"dof", "Degrees of freedom", [](ResidualRow& row) { return row.residual.degrees; }},
    {"quantile", "Share of chance's chi-squares that are smaller",
     [](ResidualRow& row) { return row.residual.quantile; }},
    {"weight", "What it counts, by --kernel or --gnc", &ResidualRow::weight},
};

void print_residuals(const factor::Problem& problem, const factor::Values& values,
                     const factor::Loss& loss, cmd::Table<ResidualRow>& table) {
  std::vector<factor::Residual> residuals = factor::residuals(problem, values);
  factor::worst_first(residuals);
  const std::vector<std::size_t> line = line_numbers(*problem.graph);
  for (const factor::Residual& residual : residuals) {
    table.row({*problem.graph, residual, factor::weight(loss, residual.edge, residual.chi2),
               line[residual.edge]});
  }
}

}  // namespace sg::solving
