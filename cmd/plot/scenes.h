// What sg-plot draws. Each scene fills a page of width x height points.
#pragma once

#include <cairo.h>

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cmd/plot/thin.h"
#include "lib/elim/score.h"
#include "lib/graph/graph.h"
#include "lib/graph/pattern.h"
#include "lib/graph/replay.h"
#include "lib/score/covariance.h"

namespace sg::plot {

struct PageSize {
  double width;
  double height;
};

// Where every vertex is, as the file has it, or composed along odometry where it has edges only.
// In the plane z is 0. Throws an input Error for a vertex type that has no known place.
std::vector<std::array<double, 3>> positions(const Graph& graph);

// From where a map is seen: the directions, of length 1, that go to the right and up.
using View = Eigen::Matrix<double, 2, 3>;
// "xy", "xz" or "yz".
View plane_view(const std::string& plane);
// From the compass direction `azimuth` (0: from the south, y goes up; 90: from the east), so high above the horizon, in
// degrees; 0,90 is "xy".
View view_from(double azimuth, double elevation);
// A flat graph as it lies; a spatial one on the plane in which its positions spread most: their principal axes.
View best_view(const Graph& graph);

// Where a map has them, on its page.
std::vector<Point> places(const Graph& graph, const View& view, const PageSize& size);

// The map, seen so: the path in blue, loop closures in orange, landmarks in green, observations as faint lines; of edges
// those of `only`. A ring is where the poses begin, a square where they end; up to 50 vertices have
// their ids. A bar tells the scale, a legend the colours. Many lines and dots are thinned (thin.h).
void draw_map(cairo_t* page, const PageSize& size, const Graph& graph, const View& view,
              const std::string& title, const std::vector<graph::EdgeRole>& only);

// The same map with variables and edges coloured, variables by what they cost, edges by what EC would lose without
// them: colour and size grow with the square root of that, in so many steps, the costliest on top; free edges are faint.
constexpr int heat_steps = 32;
struct Costs;
void draw_cost_map(cairo_t* page, const PageSize& size, const Graph& graph, const View& view,
                   const Costs& costs);

// The same map with all edges faint, and ellipses of one standard deviation around vertices, so many that they do not
// hide each other; made larger or smaller by a round factor, which the line at the top says.
void draw_sigma_map(cairo_t* page, const PageSize& size, const Graph& graph, const View& view,
                    const std::vector<score::Ellipse>& ellipses);

// R in its order, rows and columns in scalars: what A^T A has in blue, fill in orange.
void draw_pattern(cairo_t* page, const PageSize& size, const graph::Pattern& pattern,
                  const graph::Order& order);

// The Bayes tree, roots on top: a cell for every clique as wide as the cost of all that hangs on it, which stands below it;
// the shade is that of its own cost. What is narrower than can be seen is left out with all below.
void draw_tree(cairo_t* page, const PageSize& size, const elim::Symbolic& symbolic);

}  // namespace sg::plot
