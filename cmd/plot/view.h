// Where a map has things on its page: positions, the plane they are seen on, the scale.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "cmd/plot/thin.h"
#include "lib/graph/graph.h"

namespace sg::plot {

struct PageSize {
  double width;
  double height;
};

// What a picture leaves free around what it draws, in points.
constexpr double margin = 24;

using Position = std::array<double, 3>;

// Where every vertex is, as the file has it, or composed along odometry where it has edges only.
// In the plane z is 0. Throws an input Error for a vertex type that has no known place.
std::vector<Position> positions(const Graph& graph);

// From where a map is seen: the directions, of length 1, that go to the right and up.
using View = Eigen::Matrix<double, 2, 3>;
// "xy", "xz" or "yz".
View plane_view(const std::string& plane);
// From the compass direction `azimuth` (0: from the south, y goes up; 90: from the east), so high above the horizon, in
// degrees; 0,90 is "xy".
View view_from(double azimuth, double elevation);
// A flat graph as it lies; a spatial one on the plane in which its positions spread most: their principal axes.
View best_view(const Graph& graph);

// From metres to the page: one scale for both axes, the middle in the middle.
struct Projection {
  double scale = 1;  // points a metre
  Point middle{0, 0};
  Point centre{0, 0};
  Point operator()(const Point& p) const {
    return {centre.x + scale * (p.x - middle.x), centre.y - scale * (p.y - middle.y)};
  }
};

// How many shades there are from the far side of a spatial map to the near one.
constexpr int shades = 8;

struct Placed {
  std::vector<Point> at;  // on the page: every vertex, then what else there is
  std::vector<int>
      shade;  // of every vertex, 0: farthest; all are shades - 1 where nothing is behind
  Projection project;
};
// The graph's vertices and `more` positions, so that all fit.
Placed placed(const Graph& graph, const View& view, const PageSize& size,
              const std::vector<Position>& more = {});

// Where a map has its vertices, on its page.
std::vector<Point> places(const Graph& graph, const View& view, const PageSize& size);

}  // namespace sg::plot
