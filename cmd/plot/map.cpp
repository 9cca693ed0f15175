#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include "cmd/plot/heat.h"
#include "cmd/plot/picture.h"
#include "cmd/plot/scenes.h"
#include "cmd/plot/thin.h"
#include "cmd/plot/words.h"
#include "lib/factor/initialize.h"
#include "lib/factor/space.h"
#include "lib/graph/replay.h"
#include "lib/text/error.h"
#include "lib/text/words.h"

namespace sg::plot {
namespace {

constexpr double margin = 24;

// From metres to the page: one scale for both axes, the middle in the middle.
struct Projection {
  double scale;
  Point middle;
  Point centre;
  Point operator()(const Point& p) const {
    return {centre.x + scale * (p.x - middle.x), centre.y - scale * (p.y - middle.y)};
  }
};

Projection fit(const std::vector<Point>& points, const PageSize& size) {
  const auto [left, right] = std::minmax_element(
      points.begin(), points.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
  const auto [low, high] = std::minmax_element(
      points.begin(), points.end(), [](const Point& a, const Point& b) { return a.y < b.y; });
  const double width = right->x - left->x;
  const double height = high->y - low->y;
  double scale = std::min((size.width - 2 * margin) / width, (size.height - 2 * margin) / height);
  if (!std::isfinite(scale)) scale = 1;  // a single point
  return {scale, {left->x + width / 2, low->y + height / 2}, {size.width / 2, size.height / 2}};
}

// Cairo takes long over a path of many lines that cross: where there are many, it gets them in pieces.
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

void draw_edges(cairo_t* page, const Graph& graph, const std::vector<graph::EdgeRole>& roles,
                graph::EdgeRole role, const std::vector<Point>& at, std::size_t most = 40000) {
  std::vector<Segment> segments;
  for (Index e = 0; e < graph.edges(); ++e) {
    const auto ends = graph.edge(e);
    for (std::size_t k = 1; k < ends.size() && roles[e] == role; ++k)
      segments.push_back({ends[0], ends[k]});
  }
  stroke(page, thinned(std::move(segments), at, most), at);
}

void draw_dots(cairo_t* page, const Graph& graph, graph::Role role, const std::vector<Point>& at) {
  cairo_set_line_cap(page, CAIRO_LINE_CAP_ROUND);
  std::vector<Segment> dots;
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (graph.role(v) == role) dots.push_back({v, v});
  }
  stroke(page, thinned(std::move(dots), at), at);
}

// The largest of 1, 2, 5 times a power of ten that is no longer than `metres`.
double round_length(double metres) {
  const double power = std::pow(10, std::floor(std::log10(metres)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= metres) return digit * power;
  }
  return power;
}

void draw_scale_bar(cairo_t* page, const PageSize& size, double scale) {
  const double metres = round_length(size.width / 5 / scale);
  const double y = size.height - margin / 3;
  set_color(page, {0, 0, 0});
  cairo_set_line_width(page, 1.5);
  cairo_move_to(page, margin, y);
  cairo_line_to(page, margin + scale * metres, y);
  cairo_stroke(page);
  std::string label = std::to_string(metres);
  label.erase(label.find_last_not_of('0') + 1);
  if (label.back() == '.') label.pop_back();
  cairo_set_font_size(page, 10);
  cairo_move_to(page, margin + scale * metres + 4, y + 3);
  cairo_show_text(page, (label + " m").c_str());
}

}  // namespace

std::vector<std::array<double, 3>> positions(const Graph& graph) {
  factor::Problem problem;
  factor::Values values;
  if (graph.edges_only) {
    problem = factor::make_problem(graph);
    values = factor::initial_values(problem);
  }
  std::vector<std::array<double, 3>> result(graph.vertices(), {0, 0, 0});
  std::vector<double> numbers;
  for (Index v = 0; v < graph.vertices(); ++v) {
    const graph::VertexType& type = graph.type_of_vertex(v);
    const int coordinates = graph::facts(type.space).position;
    if (coordinates == 0)
      throw graph::error_at(graph, graph.vertex_line[v], type.tag + " has no place on a map");
    if (graph.edges_only) {
      numbers = factor::estimate_numbers(problem, values, v);
    } else {
      graph::vertex_numbers(graph, v, numbers);
    }
    std::copy_n(numbers.begin(), coordinates, result[v].begin());
    for (const double x : result[v]) {
      if (!std::isfinite(x))
        throw graph::error_at(graph, graph.vertex_line[v], "no finite position");
    }
  }
  return result;
}

namespace {

struct Placed {
  std::vector<Point> points;  // on the page
  double scale;               // points a metre
};

Placed placed(const Graph& graph, const View& view, const PageSize& size) {
  std::vector<Point> points;
  for (const auto& position : positions(graph)) {
    const Eigen::Vector2d seen = view * Eigen::Vector3d::Map(position.data());
    points.push_back({seen.x(), seen.y()});
  }
  const Projection project = fit(points, size);
  std::transform(points.begin(), points.end(), points.begin(), project);
  return {std::move(points), project.scale};
}

}  // namespace

View plane_view(const std::string& plane) {
  View view = View::Zero();
  for (int k = 0; k < 2; ++k) view(k, plane[k] - 'x') = 1;
  return view;
}

View view_from(double azimuth, double elevation) {
  const double a = azimuth * std::numbers::pi / 180, e = elevation * std::numbers::pi / 180;
  View view;
  view << std::cos(a), std::sin(a), 0,  //
      -std::sin(a) * std::sin(e), std::cos(a) * std::sin(e), std::cos(e);
  return view;
}

View best_view(const Graph& graph) {
  const auto points = positions(graph);
  const bool flat = std::ranges::all_of(points, [](const auto& p) { return p[2] == 0; });
  if (flat || points.size() < 3) return plane_view("xy");
  const Eigen::Matrix3Xd all = Eigen::Matrix3Xd::Map(points.front().data(), 3, points.size());
  const Eigen::Matrix3Xd around = all.colwise() - all.rowwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(around * around.transpose());
  View view = axes.eigenvectors().rightCols<2>().rowwise().reverse().transpose();
  for (int k = 0; k < 2; ++k) {  // an axis has two directions: the one along its largest coordinate
    int largest = 0;
    view.row(k).cwiseAbs().maxCoeff(&largest);
    if (view(k, largest) < 0) view.row(k) *= -1;
  }
  return view;
}

std::vector<Point> places(const Graph& graph, const View& view, const PageSize& size) {
  return placed(graph, view, size).points;
}

void draw_map(cairo_t* page, const PageSize& size, const Graph& graph, const View& view,
              const std::string& title, const std::vector<graph::EdgeRole>& only) {
  const auto [points, scale] = placed(graph, view, size);
  std::vector<graph::EdgeRole> roles = graph::edge_roles(graph, graph::pose_index(graph));
  for (graph::EdgeRole& role : roles) {
    if (std::ranges::find(only, role) == only.end()) role = graph::EdgeRole::other;
  }
  set_color(page, faint_color, 0.35);
  cairo_set_line_width(page, 0.3);
  draw_edges(page, graph, roles, graph::EdgeRole::observation, points);
  set_color(page, loop_color, 0.7);
  cairo_set_line_width(page, 0.5);
  draw_edges(page, graph, roles, graph::EdgeRole::loop_closure, points);
  set_color(page, path_color);
  cairo_set_line_width(page, 0.8);
  draw_edges(page, graph, roles, graph::EdgeRole::odometry, points);
  cairo_set_line_width(page, 1.6);
  draw_dots(page, graph, graph::Role::pose, points);
  set_color(page, landmark_color);
  cairo_set_line_width(page, 2.4);
  draw_dots(page, graph, graph::Role::landmark, points);
  draw_ends(page, graph, points);
  draw_ids(page, graph, points);
  draw_scale_bar(page, size, scale);
  std::vector<std::pair<Color, std::string>> legend;
  const auto explain = [&](graph::EdgeRole role, const Color& color, const char* words) {
    if (std::ranges::find(roles, role) != roles.end()) legend.emplace_back(color, words);
  };
  explain(graph::EdgeRole::odometry, path_color, "odometry");
  explain(graph::EdgeRole::loop_closure, loop_color, "loop closures");
  explain(graph::EdgeRole::observation, faint_color, "observations");
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (graph.role(v) != graph::Role::landmark) continue;
    legend.emplace_back(landmark_color, "landmarks");
    break;
  }
  draw_legend(page, size, legend);
  draw_title(page, size, title, margin, 2 * margin / 3, 10);
}

namespace {

void draw_faint_edges(cairo_t* page, const Graph& graph, const std::vector<Point>& points) {
  const std::vector<graph::EdgeRole> roles = graph::edge_roles(graph, graph::pose_index(graph));
  set_color(page, faint_color, 0.25);
  cairo_set_line_width(page, 0.4);
  for (const graph::EdgeRole role :
       {graph::EdgeRole::observation, graph::EdgeRole::loop_closure, graph::EdgeRole::odometry}) {
    draw_edges(page, graph, roles, role, points, 10000);
  }
}

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
                   const Costs& costs) {
  const auto [points, scale] = placed(graph, view, size);
  draw_faint_edges(page, graph, points);
  draw_heated(page, priced_edges(graph, costs), points, 0.3, 0.9);
  cairo_set_line_cap(page, CAIRO_LINE_CAP_ROUND);  // of lines without a length: dots
  draw_heated(page, variables_by_cost(costs), points, 1.4, 3.6);
  cairo_set_line_cap(page, CAIRO_LINE_CAP_BUTT);
  draw_scale_bar(page, size, scale);
  draw_cost_legend(page, size, costs);
}

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
                    const std::vector<score::Ellipse>& ellipses) {
  const auto [points, scale] = placed(graph, view, size);
  draw_faint_edges(page, graph, points);
  double longest = 0;
  for (const score::Ellipse& ellipse : ellipses) longest = std::max(longest, ellipse.axes[0]);
  const double times = enlargement(longest, scale);
  cairo_set_line_width(page, 0.5);
  for (const auto& [role, color] :
       {std::pair{graph::Role::landmark, landmark_color}, {graph::Role::pose, path_color}}) {
    for (const Index v : spread(graph, role, points)) {
      // Cairo draws nothing more once its matrix has become singular.
      if (!(ellipses[v].axes[1] * times * scale > 1e-6)) continue;
      draw_ellipse(page, points[v], ellipses[v], times * scale);
      set_color(page, color, 0.1);
      cairo_fill_preserve(page);
      set_color(page, color, 0.8);
      cairo_stroke(page);
    }
  }
  draw_scale_bar(page, size, scale);
  set_color(page, {0, 0, 0});
  cairo_move_to(page, margin, 2 * margin / 3);
  cairo_show_text(
      page,
      ("one standard deviation, drawn " + text::format_number(times) + " times as large").c_str());
}

}  // namespace sg::plot
