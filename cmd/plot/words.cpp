#include "cmd/plot/words.h"

#include <algorithm>
#include <cmath>

#include "lib/graph/replay.h"

namespace sg::plot {
namespace {

constexpr Color ink{0, 0, 0};
constexpr double margin = 24;

double width_of(cairo_t* page, const std::string& words) {
  cairo_text_extents_t extents;
  cairo_text_extents(page, words.c_str(), &extents);
  return extents.x_advance;
}

std::string number_of(Index count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

}  // namespace

std::string counted(const Graph& graph) {
  Index poses = 0, landmarks = 0;
  for (Index v = 0; v < graph.vertices(); ++v) {
    poses += graph.role(v) == graph::Role::pose;
    landmarks += graph.role(v) == graph::Role::landmark;
  }
  return graph.file.substr(graph.file.rfind('/') + 1) + ": " + number_of(poses, "pose", "poses") +
         ", " + (landmarks ? number_of(landmarks, "landmark", "landmarks") + ", " : "") +
         number_of(graph.edges(), "edge", "edges");
}

void draw_title(cairo_t* page, const PageSize& size, const std::string& words, double x, double y,
                double font) {
  set_color(page, ink);
  cairo_set_font_size(page, font);
  const double room = (size.width - 2 * x) / width_of(page, words);
  if (room < 1) cairo_set_font_size(page, font * room);
  cairo_move_to(page, x, y);
  cairo_show_text(page, words.c_str());
}

void draw_legend(cairo_t* page, const PageSize& size,
                 const std::vector<std::pair<Color, std::string>>& entries) {
  constexpr double font = 10, gap = 12, dot = 3;
  cairo_set_font_size(page, font);
  double width = 0;
  for (const auto& [color, words] : entries) width += 3 * dot + width_of(page, words) + gap;
  const double y = size.height - margin / 3;
  double x = size.width - margin - width + gap;
  if (x < size.width / 5 + 80) return;  // the bar and its label have that
  for (const auto& [color, words] : entries) {
    set_color(page, color);
    cairo_arc(page, x + dot, y, dot, 0, 2 * M_PI);
    cairo_fill(page);
    set_color(page, ink);
    cairo_move_to(page, x + 3 * dot, y + 3);
    cairo_show_text(page, words.c_str());
    x += 3 * dot + width_of(page, words) + gap;
  }
}

void draw_ends(cairo_t* page, const Graph& graph, const std::vector<Point>& at) {
  const graph::PoseIndex poses = graph::pose_index(graph);
  if (poses.pose.size() < 2) return;
  constexpr double radius = 4;
  set_color(page, ink);
  cairo_set_line_width(page, 1.2);
  const Point first = at[poses.pose.front()], last = at[poses.pose.back()];
  cairo_new_sub_path(page);
  cairo_arc(page, first.x, first.y, radius, 0, 2 * M_PI);
  cairo_stroke(page);
  cairo_rectangle(page, last.x - radius, last.y - radius, 2 * radius, 2 * radius);
  cairo_stroke(page);
}

void draw_ids(cairo_t* page, const Graph& graph, const std::vector<Point>& at) {
  if (graph.vertices() > 50) return;
  set_color(page, ink);
  cairo_set_font_size(page, 8);
  for (Index v = 0; v < graph.vertices(); ++v) {
    cairo_move_to(page, at[v].x + 4, at[v].y - 4);
    cairo_show_text(page, std::to_string(graph.id[v]).c_str());
  }
}

}  // namespace sg::plot
