// What sg-plot draws. Each scene fills a page of width x height points.
#pragma once

#include <cairo.h>

#include <array>
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

// Where a map has them, on its page.
std::vector<Point> places(const Graph& graph, const std::array<int, 2>& axes, const PageSize& size);

// The map, seen along the axis that is left when `axes` (of 0, 1, 2) go to the right and up: the
// path in blue, loop closures in orange, landmarks in green, observations as faint lines; of edges
// those of `only`. A ring is where the poses begin, a square where they end; up to 50 vertices have
// their ids. A bar tells the scale, a legend the colours. Many lines and dots are thinned (thin.h).
void draw_map(cairo_t* page, const PageSize& size, const Graph& graph,
              const std::array<int, 2>& axes, const std::string& title,
              const std::vector<graph::EdgeRole>& only);

// The same map with variables and edges coloured, variables by what they cost, edges by what EC would lose without
// them: colour and size grow with the square root of that, in so many steps, the costliest on top; free edges are faint.
constexpr int heat_steps = 32;
struct Costs;
void draw_cost_map(cairo_t* page, const PageSize& size, const Graph& graph,
                   const std::array<int, 2>& axes, const Costs& costs);

// The same map with all edges faint, and ellipses of one standard deviation around vertices, so many that they do not
// hide each other; made larger or smaller by a round factor, which the line at the top says.
void draw_sigma_map(cairo_t* page, const PageSize& size, const Graph& graph,
                    const std::array<int, 2>& axes, const std::vector<score::Ellipse>& ellipses);

// R in its order, rows and columns in scalars: what A^T A has in blue, fill in orange.
void draw_pattern(cairo_t* page, const PageSize& size, const graph::Pattern& pattern,
                  const graph::Order& order);

// The Bayes tree, roots on top: a circle for every clique, its area in proportion to the clique's
// dimension.
void draw_tree(cairo_t* page, const PageSize& size, const elim::Symbolic& symbolic);

}  // namespace sg::plot
