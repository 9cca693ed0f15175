// Many lines and dots: thinned, in pieces, the far side first and paler.
#pragma once

#include <cairo.h>

#include <vector>

#include "cmd/plot/picture.h"
#include "cmd/plot/thin.h"
#include "cmd/plot/view.h"
#include "lib/graph/graph.h"
#include "lib/graph/replay.h"

namespace sg::plot {

// Cairo takes long over a path of many lines that cross: where there are many, it gets them in pieces.
void stroke(cairo_t* page, const std::vector<Segment>& segments, const std::vector<Point>& at);

// From the first vertex of every edge of that role to each of its others; the vertices of a role.
std::vector<Segment> edges_of(const Graph& graph, const std::vector<graph::EdgeRole>& roles,
                              graph::EdgeRole role);
std::vector<Segment> vertices_of(const Graph& graph, graph::Role role);

// Lines, or dots (of which each joins a point to itself), that look alike.
struct Layer {
  std::vector<Segment> segments;
  Color color;
  double opacity, width;
};
// One layer on the other; of a map that is deep, all of the farthest shade before all of the next.
void draw_layers(cairo_t* page, std::vector<Layer> layers, const Placed& placed);

// All edges, as a background.
void draw_faint_edges(cairo_t* page, const Graph& graph, const Placed& placed);

}  // namespace sg::plot
