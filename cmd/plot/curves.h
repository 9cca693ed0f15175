// Curves of a table: any of the commands', a header line and rows, cells separated by tabs.
#pragma once

#include <cairo.h>

#include <string>
#include <string_view>
#include <vector>

#include "cmd/plot/view.h"

namespace sg::plot {

struct Curve {
  std::string name;
  std::vector<Point> points;
};
struct Curves {
  std::string title;  // the files and how many rows they have
  std::string x;      // the column that goes to the right
  std::vector<Curve>
      curves;  // of every other column; where columns of words tell rows apart, one for each of those
};

struct TableText {
  std::string file;
  std::string_view text;
};
// `columns`: the first goes to the right; where none are named, the first that has numbers, and all others that have. Of
// several tables each curve is called by its file, too. Cells without a value are passed over. Throws an input Error for
// a text that is no such table, and for tables that do not share what goes to the right; a usage Error for a name that is
// no column.
Curves read_curves(const std::vector<TableText>& tables, const std::vector<std::string>& columns);

// Points that a logarithm cannot show are left out.
struct LogAxes {
  bool x = false, y = false;
};
void draw_curves(cairo_t* page, const PageSize& size, const Curves& curves, const LogAxes& log);

}  // namespace sg::plot
