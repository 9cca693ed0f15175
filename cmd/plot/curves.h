// Curves of a table: any of the commands', a header line and rows, cells separated by tabs.
#pragma once

#include <cairo.h>

#include <string>
#include <string_view>
#include <vector>

#include "cmd/plot/scenes.h"
#include "cmd/plot/thin.h"

namespace sg::plot {

struct Curve {
  std::string name;
  std::vector<Point> points;
};
struct Curves {
  std::string x;  // what goes to the right: the first column that has numbers
  std::vector<Curve>
      curves;  // a column of numbers each; where columns of words tell rows apart, one for each of those
};
// Cells without a value are passed over. Throws an input Error for a text that is no such table.
Curves read_curves(std::string_view text, const std::string& file);

// Points that a logarithm cannot show are left out.
struct LogAxes {
  bool x = false, y = false;
};
void draw_curves(cairo_t* page, const PageSize& size, const Curves& curves, const LogAxes& log);

}  // namespace sg::plot
