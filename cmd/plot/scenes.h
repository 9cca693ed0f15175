// What sg-plot draws. Each scene fills a page of width x height points.
#pragma once

#include <cairo.h>

#include <vector>

#include "cmd/plot/view.h"
#include "cmd/plot/words.h"
#include "lib/elim/score.h"
#include "lib/graph/graph.h"
#include "lib/graph/pattern.h"
#include "lib/graph/replay.h"
#include "lib/score/covariance.h"

namespace sg::plot {

struct Overlay;
// The map, seen so: the path in blue, loop closures in orange, landmarks in green, observations as faint lines, what is
// behind paler; of edges those of `only`. A ring is where the poses begin, a square where they end; up to 50 vertices have
// their ids. Numbers at the edges and a bar tell lengths, a legend the colours. Many lines and dots are thinned (thin.h).
// Over it another trajectory, if there is one.
void draw_map(cairo_t* page, const PageSize& size, const Graph& graph, const View& view,
              const Heading& heading, const std::vector<graph::EdgeRole>& only,
              const Overlay* overlay = nullptr);

// The same map with variables and edges coloured, variables by what they cost, edges by what EC would lose without
// them: colour and size grow with the square root of that, in so many steps, the costliest on top; free edges are faint.
constexpr int heat_steps = 32;
struct Costs;
void draw_cost_map(cairo_t* page, const PageSize& size, const Graph& graph, const View& view,
                   const Costs& costs, const Heading& heading);

// The same map with all edges faint, and ellipses of one standard deviation around vertices, so many that they do not
// hide each other; made larger or smaller by a round factor, which the heading's second line is made to say.
void draw_sigma_map(cairo_t* page, const PageSize& size, const Graph& graph, const View& view,
                    const std::vector<score::Ellipse>& ellipses, Heading heading);

// R in its order, rows and columns in scalars: what A^T A has in blue, fill in orange.
void draw_pattern(cairo_t* page, const PageSize& size, const graph::Pattern& pattern,
                  const graph::Order& order, const Heading& heading);

// The Bayes tree, roots on top: a cell for every clique as wide as the cost of all that hangs on it, which stands below it;
// the shade is that of its own cost. What is narrower than can be seen is left out with all below.
void draw_tree(cairo_t* page, const PageSize& size, const elim::Symbolic& symbolic,
               Heading heading);

}  // namespace sg::plot
