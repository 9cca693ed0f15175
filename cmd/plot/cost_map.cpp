#include <array>
#include <cmath>

#include "cmd/plot/axes.h"
#include "cmd/plot/heat.h"
#include "cmd/plot/scenes.h"
#include "cmd/plot/strokes.h"
#include "cmd/plot/words.h"

namespace sg::plot {
namespace {

// Lines and dots by their step of heat.
using Heated = std::array<std::vector<Segment>, heat_steps + 1>;

std::size_t step_of(double value, double largest) {
  return static_cast<std::size_t>(std::lround(heat_steps * std::sqrt(value / largest)));
}

constexpr std::size_t most_of_a_step = 2000;

// Step by step, each one colour and one width, which grows by so much with the heat, the hottest on top.
void draw_heated(cairo_t* page, Heated heated, const std::vector<Point>& at, double least,
                 double growth) {
  for (std::size_t k = 0; k < heated.size(); ++k) {
    const double value = static_cast<double>(k) / heat_steps;
    set_color(page, heat(value));
    cairo_set_line_width(page, least + growth * value);
    stroke(page, thinned(std::move(heated[k]), at, most_of_a_step), at);
  }
}

// Those that are not free.
Heated priced_edges(const Graph& graph, const Costs& costs) {
  Heated result;
  for (Index e = 0; e < graph.edges(); ++e) {
    const auto ends = graph.edge(e);
    for (std::size_t k = 1; k < ends.size() && costs.edge[e] > 0; ++k)
      result[step_of(costs.edge[e], costs.largest_edge)].push_back({ends[0], ends[k]});
  }
  return result;
}

Heated variables_by_cost(const Costs& costs) {
  Heated result;
  for (const Index v : costs.ascending)
    result[step_of(costs.vertex[v], costs.largest)].push_back({v, v});
  return result;
}

}  // namespace

void draw_cost_map(cairo_t* page, const PageSize& size, const Graph& graph, const View& view,
                   const Costs& costs, const Heading& heading) {
  const Placed placed = plot::placed(graph, view, size);
  draw_faint_edges(page, graph, placed);
  draw_heated(page, priced_edges(graph, costs), placed.at, 0.3, 0.9);
  cairo_set_line_cap(page, CAIRO_LINE_CAP_ROUND);  // of lines without a length: dots
  draw_heated(page, variables_by_cost(costs), placed.at, 1.4, 3.6);
  cairo_set_line_cap(page, CAIRO_LINE_CAP_BUTT);
  draw_ends(page, graph, placed.at);
  draw_ids(page, graph, placed.at);
  draw_map_axes(page, size, view, placed.project);
  draw_scale_bar(page, size, placed.project.scale);
  draw_heat_legend(page, size, "share of EC", costs.largest, costs.total);
  draw_heading(page, size, heading);
}

}  // namespace sg::plot
