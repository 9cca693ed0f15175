#include <algorithm>

#include "cmd/plot/axes.h"
#include "cmd/plot/overlay.h"
#include "cmd/plot/scenes.h"
#include "cmd/plot/strokes.h"
#include "cmd/plot/words.h"

namespace sg::plot {
namespace {

std::vector<std::pair<Color, std::string>> legend(const Graph& graph,
                                                  const std::vector<graph::EdgeRole>& roles,
                                                  const Overlay* overlay) {
  std::vector<std::pair<Color, std::string>> entries;
  const auto explain = [&](graph::EdgeRole role, const Color& color) {
    if (std::ranges::find(roles, role) != roles.end()) entries.emplace_back(color, name_of(role));
  };
  explain(graph::EdgeRole::odometry, path_color);
  explain(graph::EdgeRole::loop_closure, loop_color);
  explain(graph::EdgeRole::observation, faint_color);
  if (!vertices_of(graph, graph::Role::landmark).empty())
    entries.emplace_back(landmark_color, "landmarks");
  if (overlay) entries.emplace_back(overlay_color, overlay->name);
  if (overlay) entries.emplace_back(error_color, "error");
  return entries;
}

}  // namespace

void draw_map(cairo_t* page, const PageSize& size, const Graph& graph, const View& view,
              const Heading& heading, const std::vector<graph::EdgeRole>& only,
              const Overlay* overlay) {
  std::vector<graph::EdgeRole> roles = graph::edge_roles(graph, graph::pose_index(graph));
  for (graph::EdgeRole& role : roles) {
    if (std::ranges::find(only, role) == only.end()) role = graph::EdgeRole::other;
  }
  const auto edges = [&](graph::EdgeRole role) { return edges_of(graph, roles, role); };
  std::vector<Layer> layers{
      {edges(graph::EdgeRole::loop_closure), loop_color, 0.7, 0.5},
      {edges(graph::EdgeRole::odometry), path_color, 1, 0.8},
      {vertices_of(graph, graph::Role::pose), path_color, 1, 1.6},
  };
  if (overlay) {
    layers.push_back({overlay->path, overlay_color, 1, 0.8});
    layers.push_back({overlay->whiskers, error_color, 0.8, 0.5});
  }
  const Placed placed =
      plot::placed(graph, view, size, overlay ? overlay->positions : std::vector<Position>{});
  // Observations and landmarks are many, and would hide what is behind them.
  draw_layers(page,
              {{edges(graph::EdgeRole::observation), faint_color, 0.35, 0.3},
               {vertices_of(graph, graph::Role::landmark), landmark_color, 1, 2.4}},
              placed);
  draw_layers(page, std::move(layers), placed);
  draw_ends(page, graph, placed.at);
  draw_ids(page, graph, placed.at);
  draw_map_axes(page, size, view, placed.project);
  draw_scale_bar(page, size, placed.project.scale);
  draw_legend(page, size, legend(graph, roles, overlay));
  draw_heading(page, size, heading);
}

}  // namespace sg::plot
