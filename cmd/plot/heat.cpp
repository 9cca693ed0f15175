#include "cmd/plot/heat.h"

#include <algorithm>
#include <array>

#include "cmd/plot/unsolved.h"
#include "lib/elim/row_price.h"

namespace sg::plot {
// Brewer's YlOrRd.
Color heat(double value) {
  constexpr std::array<Color, 6> stops{{{1, 0.93, 0.63},
                                        {1, 0.85, 0.46},
                                        {1, 0.7, 0.3},
                                        {0.99, 0.43, 0.18},
                                        {0.85, 0.1, 0.11},
                                        {0.5, 0, 0.15}}};
  const double at = std::clamp(value, 0.0, 1.0) * (stops.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  const double f = at - static_cast<double>(k);
  const auto mix = [f](double a, double b) { return a + f * (b - a); };
  return {mix(stops[k].red, stops[k + 1].red), mix(stops[k].green, stops[k + 1].green),
          mix(stops[k].blue, stops[k + 1].blue)};
}

Costs costs(const graph::GraphPattern& variables, const graph::Order& order) {
  const elim::Symbolic symbolic = elim::symbolic(variables.pattern, order);
  Costs result;
  result.vertex.assign(variables.vertex_variable.size(), 0);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Index v = variables.variable_vertex[order[k]];
    const elim::Wide cost = elim::elimination_cost(symbolic.dim[k], symbolic.count[k]);
    result.vertex[v] = elim::to_double(cost);
    result.ec += cost;
    result.largest = std::max(result.largest, result.vertex[v]);
  }
  result.total = elim::to_double(result.ec);
  result.ascending = variables.variable_vertex;
  std::ranges::stable_sort(result.ascending, {}, [&](Index v) { return result.vertex[v]; });
  for (const elim::Wide price : elim::row_prices(variables.pattern, order))
    result.edge.push_back(elim::to_double(price));
  for (const double price : result.edge) result.largest_edge = std::max(result.largest_edge, price);
  return result;
}

Index half(const Costs& costs) {
  Index count = 0;
  double sum = 0;
  for (auto v = costs.ascending.rbegin(); v != costs.ascending.rend() && sum < costs.total / 2;
       ++v) {
    sum += costs.vertex[*v];
    ++count;
  }
  return count;
}

Heading cost_heading(const Graph& graph, const Costs& costs, const std::string& order) {
  const std::string hint = unsolved_hint(graph);
  return {title(graph, costs.ec, order),
          "half of EC in " + std::to_string(half(costs)) + " of " +
              counted(static_cast<Index>(costs.ascending.size()), "variable", "variables") +
              (hint.empty() ? "" : "; " + hint)};
}

}  // namespace sg::plot
