#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "cmd/plot/axes.h"
#include "cmd/plot/scenes.h"
#include "cmd/plot/strokes.h"
#include "cmd/plot/words.h"
#include "lib/text/words.h"

namespace sg::plot {
namespace {

// How many times as large as they are ellipses are drawn, the largest with half an axis of `longest` metres: as far as
// the map's margin.
double enlargement(double longest, double scale) {
  return longest > 0 ? round_length(margin / (longest * scale)) : 1;
}

// The first vertex of a role in every square of some points: more ellipses would hide each other.
std::vector<Index> spread(const Graph& graph, graph::Role role, const std::vector<Point>& points) {
  constexpr double square = 12;
  std::set<std::pair<double, double>> taken;
  std::vector<Index> result;
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (graph.role(v) != role) continue;
    const Point& at = points[v];
    if (taken.emplace(std::floor(at.x / square), std::floor(at.y / square)).second)
      result.push_back(v);
  }
  return result;
}

void draw_ellipse(cairo_t* page, const Point& at, const score::Ellipse& ellipse, double scale) {
  cairo_save(page);
  cairo_translate(page, at.x, at.y);
  cairo_rotate(page, -ellipse.angle);  // the page's y points down
  cairo_scale(page, scale * ellipse.axes[0], scale * ellipse.axes[1]);
  cairo_arc(page, 0, 0, 1, 0, 2 * M_PI);
  cairo_restore(page);  // or the line would be scaled, too
}

}  // namespace

void draw_sigma_map(cairo_t* page, const PageSize& size, const Graph& graph, const View& view,
                    const std::vector<score::Ellipse>& ellipses, Heading heading) {
  const Placed placed = plot::placed(graph, view, size);
  const double scale = placed.project.scale;
  draw_faint_edges(page, graph, placed);
  double longest = 0;
  for (const score::Ellipse& ellipse : ellipses) longest = std::max(longest, ellipse.axes[0]);
  const double times = enlargement(longest, scale);
  std::vector<std::pair<Color, std::string>> legend;
  cairo_set_line_width(page, 0.5);
  for (const auto& [role, color, name] :
       {std::tuple{graph::Role::landmark, landmark_color, "landmarks"},
        {graph::Role::pose, path_color, "poses"}}) {
    const std::vector<Index> shown = spread(graph, role, placed.at);
    if (!shown.empty()) legend.emplace_back(color, name);
    for (const Index v : shown) {
      // Cairo draws nothing more once its matrix has become singular.
      if (!(ellipses[v].axes[1] * times * scale > 1e-6)) continue;
      draw_ellipse(page, placed.at[v], ellipses[v], times * scale);
      set_color(page, color, 0.1);
      cairo_fill_preserve(page);
      set_color(page, color, 0.8);
      cairo_stroke(page);
    }
  }
  draw_ends(page, graph, placed.at);
  draw_ids(page, graph, placed.at);
  draw_map_axes(page, size, view, placed.project);
  draw_scale_bar(page, size, scale);
  draw_legend(page, size, legend);
  const std::string drawn =
      "one standard deviation, drawn " + text::format_number(times) + " times as large";
  heading.below = heading.below.empty() ? drawn : drawn + "; " + heading.below;
  draw_heading(page, size, heading);
}

}  // namespace sg::plot
