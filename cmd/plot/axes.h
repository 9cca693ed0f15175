// What tells lengths: round numbers along an axis, a scale bar.
#pragma once

#include <cairo.h>

#include <string>
#include <vector>

#include "cmd/plot/view.h"

namespace sg::plot {

// The largest of 1, 2, 5 times a power of ten that is no longer than `length`.
double round_length(double length);

// The round numbers from low to high: 1, 2 or 5 times a power of ten apart, so that there are about so many.
double round_step(double low, double high, double about);
std::vector<double> round_numbers(double low, double high, double step);

// So long are the words in the font that is set.
double width_of(cairo_t* page, const std::string& words);

// A bar of a round number of metres at the lower left.
void draw_scale_bar(cairo_t* page, const PageSize& size, double scale);

// Along the lower and the left edge, in metres; the axis has its name where it is one of the graph's.
void draw_map_axes(cairo_t* page, const PageSize& size, const View& view,
                   const Projection& project);

}  // namespace sg::plot
