#include "cmd/plot/view.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/factor/initialize.h"
#include "lib/factor/space.h"
#include "lib/text/error.h"

namespace sg::plot {
namespace {

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

// What is less deep than this part of its width has no far side.
constexpr double least_depth = 0.05;

std::vector<int> shades_of(const std::vector<double>& depth, double width) {
  const auto [far, near] = std::ranges::minmax(depth);
  std::vector<int> result(depth.size(), shades - 1);
  if (!(near - far > least_depth * width)) return result;
  std::ranges::transform(depth, result.begin(), [far = far, near = near](double d) {
    return std::min(shades - 1, static_cast<int>(shades * (d - far) / (near - far)));
  });
  return result;
}

}  // namespace

std::vector<Position> positions(const Graph& graph) {
  factor::Problem problem;
  factor::Values values;
  if (graph.edges_only) {
    problem = factor::make_problem(graph);
    values = factor::initial_values(problem);
  }
  std::vector<Position> result(graph.vertices(), {0, 0, 0});
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

Placed placed(const Graph& graph, const View& view, const PageSize& size,
              const std::vector<Position>& more) {
  std::vector<Position> all = positions(graph);
  all.insert(all.end(), more.begin(), more.end());
  const Eigen::RowVector3d towards_us = view.row(0).cross(view.row(1));
  Placed result;
  std::vector<double> depth;
  for (const Position& position : all) {
    const Eigen::Map<const Eigen::Vector3d> p(position.data());
    const Eigen::Vector2d seen = view * p;
    result.at.push_back({seen.x(), seen.y()});
    depth.push_back(towards_us * p);
  }
  result.project = fit(result.at, size);
  std::ranges::transform(result.at, result.at.begin(), result.project);
  result.shade = shades_of(depth, std::min(size.width, size.height) / result.project.scale);
  return result;
}

std::vector<Point> places(const Graph& graph, const View& view, const PageSize& size) {
  return placed(graph, view, size).at;
}

}  // namespace sg::plot
