// What a picture says in words: of what it is, what its colours mean, which vertex is which.
#pragma once

#include <cairo.h>

#include <string>
#include <utility>
#include <vector>

#include "cmd/plot/picture.h"
#include "cmd/plot/view.h"
#include "lib/elim/score.h"
#include "lib/graph/graph.h"
#include "lib/graph/replay.h"

namespace sg::plot {

// "1 edge", "2 edges"
std::string counted(Index count, const char* one, const char* many);
// "walk.g2o: 5 poses, 2 landmarks, 11 edges"; and with ", EC 697 (colamd)" behind
std::string counted(const Graph& graph);
std::string title(const Graph& graph, elim::Wide ec, const std::string& order);

// What a picture calls edges of a role.
const char* name_of(graph::EdgeRole role);

// What stands above a picture, in two lines, in letters so small that they fit; a single line stands where a heading without
// one below does.
struct Heading {
  std::string title;
  std::string below = {};
};
void draw_heading(cairo_t* page, const PageSize& size, const Heading& heading);

// At the lower right, where there is room: each word behind a dot of its colour.
void draw_legend(cairo_t* page, const PageSize& size,
                 const std::vector<std::pair<Color, std::string>>& entries);

// At the lower right, the colours of heat.h: the darkest is `largest` of `total`, in percent.
void draw_heat_legend(cairo_t* page, const PageSize& size, const std::string& what, double largest,
                      double total);

// A ring around the first pose and a square around the last one.
void draw_ends(cairo_t* page, const Graph& graph, const std::vector<Point>& at);

// The ids of up to 50 vertices, beside them; of more, nothing.
void draw_ids(cairo_t* page, const Graph& graph, const std::vector<Point>& at);

}  // namespace sg::plot
