#include "cmd/plot/strokes.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

namespace sg::plot {
namespace {

// Towards the white of the page, by up to three quarters.
Color paler(const Color& color, int shade) {
  const double part = 0.75 * (shades - 1 - shade) / (shades - 1);
  const auto mix = [part](double x) { return x + part * (1 - x); };
  return {mix(color.red), mix(color.green), mix(color.blue)};
}

int shade_of(const Segment& segment, const Placed& placed) {
  return (placed.shade[segment.from] + placed.shade[segment.to] + 1) / 2;
}

// What is near is what stays of those that cannot be told apart.
std::vector<Segment> thinned_behind(std::vector<Segment> segments, const Placed& placed) {
  if (std::ranges::adjacent_find(placed.shade, std::ranges::not_equal_to()) != placed.shade.end()) {
    const auto by_shade = graph::counting_sort<Segment>(shades, [&](auto put) {
      for (const Segment& segment : segments) put(shades - 1 - shade_of(segment, placed), segment);
    });
    segments = by_shade.items;
  }
  return thinned(std::move(segments), placed.at);
}

}  // namespace

void stroke(cairo_t* page, const std::vector<Segment>& segments, const std::vector<Point>& at) {
  constexpr std::size_t many = 5000, piece = 200;
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const auto& [from, to] = segments[k];
    cairo_move_to(page, at[from].x, at[from].y);
    if (from == to) {
      cairo_close_path(page);  // of no length: its caps are the dot
    } else {
      cairo_line_to(page, at[to].x, at[to].y);
    }
    if (segments.size() > many && k % piece == piece - 1) cairo_stroke(page);
  }
  cairo_stroke(page);
}

std::vector<Segment> edges_of(const Graph& graph, const std::vector<graph::EdgeRole>& roles,
                              graph::EdgeRole role) {
  std::vector<Segment> segments;
  for (Index e = 0; e < graph.edges(); ++e) {
    const auto ends = graph.edge(e);
    for (std::size_t k = 1; k < ends.size() && roles[e] == role; ++k)
      segments.push_back({ends[0], ends[k]});
  }
  return segments;
}

std::vector<Segment> vertices_of(const Graph& graph, graph::Role role) {
  std::vector<Segment> dots;
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (graph.role(v) == role) dots.push_back({v, v});
  }
  return dots;
}

void draw_layers(cairo_t* page, std::vector<Layer> layers, const Placed& placed) {
  for (Layer& layer : layers) layer.segments = thinned_behind(std::move(layer.segments), placed);
  for (int shade = 0; shade < shades; ++shade) {
    for (const Layer& layer : layers) {
      std::vector<Segment> here;
      std::ranges::copy_if(layer.segments, std::back_inserter(here), [&](const Segment& segment) {
        return shade_of(segment, placed) == shade;
      });
      if (here.empty()) continue;
      set_color(page, paler(layer.color, shade), layer.opacity);
      cairo_set_line_width(page, layer.width);
      const bool dots =
          here.front().from == here.front().to;  // lines without a length, of round ends
      cairo_set_line_cap(page, dots ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
      stroke(page, here, placed.at);
    }
  }
  cairo_set_line_cap(page, CAIRO_LINE_CAP_BUTT);
}

void draw_faint_edges(cairo_t* page, const Graph& graph, const Placed& placed) {
  constexpr std::size_t most = 10000;
  const std::vector<graph::EdgeRole> roles = graph::edge_roles(graph, graph::pose_index(graph));
  set_color(page, faint_color, 0.25);
  cairo_set_line_width(page, 0.4);
  for (const graph::EdgeRole role :
       {graph::EdgeRole::observation, graph::EdgeRole::loop_closure, graph::EdgeRole::odometry}) {
    stroke(page, thinned(edges_of(graph, roles, role), placed.at, most), placed.at);
  }
}

}  // namespace sg::plot
