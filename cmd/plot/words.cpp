#include "cmd/plot/words.h"

#include <algorithm>
#include <cmath>

#include "cmd/common/table.h"
#include "cmd/plot/axes.h"
#include "cmd/plot/heat.h"

namespace sg::plot {
namespace {

constexpr Color ink{0, 0, 0};

// Right-aligned at x. Returns where the words begin.
double show_left_of(cairo_t* page, double x, double y, const std::string& words) {
  cairo_text_extents_t extents;
  cairo_text_extents(page, words.c_str(), &extents);
  cairo_move_to(page, x - extents.x_advance, y);
  cairo_show_text(page, words.c_str());
  return x - extents.x_advance;
}

}  // namespace

std::string counted(Index count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string counted(const Graph& graph) {
  Index poses = 0, landmarks = 0;
  for (Index v = 0; v < graph.vertices(); ++v) {
    poses += graph.role(v) == graph::Role::pose;
    landmarks += graph.role(v) == graph::Role::landmark;
  }
  return graph.file.substr(graph.file.rfind('/') + 1) + ": " + counted(poses, "pose", "poses") +
         ", " + (landmarks ? counted(landmarks, "landmark", "landmarks") + ", " : "") +
         counted(graph.edges(), "edge", "edges");
}

std::string title(const Graph& graph, elim::Wide ec, const std::string& order) {
  return counted(graph) + ", EC " + elim::to_string(ec) + " (" + order + ")";
}

const char* name_of(graph::EdgeRole role) {
  switch (role) {
    case graph::EdgeRole::odometry:
      return "odometry";
    case graph::EdgeRole::loop_closure:
      return "loop closures";
    case graph::EdgeRole::observation:
      return "observations";
    default:
      return "other edges";
  }
}

void draw_heading(cairo_t* page, const PageSize& size, const Heading& heading) {
  const auto line = [&](const std::string& words, double y, double font) {
    set_color(page, ink);
    cairo_set_font_size(page, font);
    const double room = (size.width - 2 * margin) / width_of(page, words);
    if (room < 1) cairo_set_font_size(page, font * room);
    cairo_move_to(page, margin, y);
    cairo_show_text(page, words.c_str());
  };
  line(heading.title, heading.below.empty() ? 15 : 10, 10);
  if (!heading.below.empty()) line(heading.below, 20, 8);
}

void draw_legend(cairo_t* page, const PageSize& size,
                 const std::vector<std::pair<Color, std::string>>& entries) {
  constexpr double gap = 12, dot = 3, least = 5;
  // The bar and its label have the left.
  const double room = size.width - margin - (size.width / 5 + 80);
  const auto width = [&](double font) {
    cairo_set_font_size(page, font);
    double sum = -gap;
    for (const auto& [color, words] : entries) sum += 3 * dot + width_of(page, words) + gap;
    return sum;
  };
  double font = 10;
  while (font > least && width(font) > room) --font;
  if (width(font) > room) return;
  const double y = size.height - margin / 3;
  double x = size.width - margin - width(font);
  for (const auto& [color, words] : entries) {
    set_color(page, color);
    cairo_arc(page, x + dot, y, dot, 0, 2 * M_PI);
    cairo_fill(page);
    set_color(page, ink);
    cairo_move_to(page, x + 3 * dot, y + font / 3);
    cairo_show_text(page, words.c_str());
    x += 3 * dot + width_of(page, words) + gap;
  }
}

void draw_heat_legend(cairo_t* page, const PageSize& size, const std::string& what, double largest,
                      double total) {
  constexpr int steps = 40;
  constexpr double length = 80, height = 8;
  const double y = size.height - margin / 3;
  set_color(page, ink);
  cairo_set_font_size(page, 10);
  const double percent = total > 0 ? 100 * largest / total : 0;
  const double from =
      show_left_of(page, size.width - margin, y + 3, cmd::rounded(percent, 3) + " %") - length - 4;
  show_left_of(page, from - 4, y + 3, what + "  0");
  for (int i = 0; i < steps; ++i) {
    set_color(page, heat(static_cast<double>(i) / (steps - 1)));
    cairo_rectangle(page, from + i * length / steps, y - height / 2, length / steps, height);
    cairo_fill(page);
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
