#include "cmd/plot/heat.h"

#include <algorithm>
#include <array>

#include "cmd/common/table.h"
#include "lib/elim/row_price.h"

namespace sg::plot {
namespace {

constexpr double margin = 24;

// Right-aligned at x. Returns where the words begin.
double show_left_of(cairo_t* page, double x, double y, const std::string& words) {
  cairo_text_extents_t extents;
  cairo_text_extents(page, words.c_str(), &extents);
  cairo_move_to(page, x - extents.x_advance, y);
  cairo_show_text(page, words.c_str());
  return x - extents.x_advance;
}

}  // namespace

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

Costs costs(const graph::GraphPattern& variables, const graph::Order& order, std::string name) {
  const elim::Symbolic symbolic = elim::symbolic(variables.pattern, order);
  Costs result;
  result.order = std::move(name);
  result.vertex.assign(variables.vertex_variable.size(), 0);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Index v = variables.variable_vertex[order[k]];
    result.vertex[v] = elim::to_double(elim::elimination_cost(symbolic.dim[k], symbolic.count[k]));
    result.total += result.vertex[v];
    result.largest = std::max(result.largest, result.vertex[v]);
  }
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

void draw_cost_legend(cairo_t* page, const PageSize& size, const Costs& costs) {
  constexpr int steps = 40;
  constexpr double length = 80, height = 8;
  const double y = size.height - margin / 3;
  set_color(page, {0, 0, 0});
  cairo_set_font_size(page, 10);
  cairo_move_to(page, margin, 2 * margin / 3);
  cairo_show_text(page, ("EC " + cmd::rounded(costs.total, 3) + " (" + costs.order +
                         "), half of it in " + std::to_string(half(costs)) + " of " +
                         std::to_string(costs.ascending.size()) + " variables")
                            .c_str());
  const double percent = costs.total > 0 ? 100 * costs.largest / costs.total : 0;
  const double from =
      show_left_of(page, size.width - margin, y + 3, cmd::rounded(percent, 3) + " %") - length - 4;
  show_left_of(page, from - 4, y + 3, "share of EC  0");
  for (int i = 0; i < steps; ++i) {
    set_color(page, heat(static_cast<double>(i) / (steps - 1)));
    cairo_rectangle(page, from + i * length / steps, y - height / 2, length / steps, height);
    cairo_fill(page);
  }
}

}  // namespace sg::plot
