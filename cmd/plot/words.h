// What a picture says in words: of what it is, what its colours mean, which vertex is which.
#pragma once

#include <cairo.h>

#include <string>
#include <utility>
#include <vector>

#include "cmd/plot/picture.h"
#include "cmd/plot/scenes.h"
#include "cmd/plot/thin.h"
#include "lib/graph/graph.h"

namespace sg::plot {

// "walk.g2o: 5 poses, 2 landmarks, 11 edges"
std::string counted(const Graph& graph);

// A line that begins at x, y, in letters of `font` points, or of so many fewer that it fits.
void draw_title(cairo_t* page, const PageSize& size, const std::string& words, double x, double y,
                double font);

// At the lower right, where there is room: each word behind a dot of its colour.
void draw_legend(cairo_t* page, const PageSize& size,
                 const std::vector<std::pair<Color, std::string>>& entries);

// A ring around the first pose and a square around the last one.
void draw_ends(cairo_t* page, const Graph& graph, const std::vector<Point>& at);

// The ids of up to 50 vertices, beside them; of more, nothing.
void draw_ids(cairo_t* page, const Graph& graph, const std::vector<Point>& at);

}  // namespace sg::plot
