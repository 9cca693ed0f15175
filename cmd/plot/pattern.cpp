#include <algorithm>
#include <cstdint>

#include "cmd/plot/picture.h"
#include "cmd/plot/scenes.h"
#include "cmd/plot/words.h"
#include "lib/elim/structure.h"

namespace sg::plot {
namespace {

constexpr std::int64_t most_cells = 1000;  // a side: finer than a screen shows

enum class Cell : std::uint8_t { empty, fill, system };

// A square of cells, each as many scalars wide as it takes.
struct Raster {
  std::vector<std::int64_t> start;  // n + 1: first scalar of every position
  std::int64_t cells;               // a side
  std::vector<Cell> cell;           // cells * cells, by row

  std::int64_t first(Index k) const { return start[k] * cells / start.back(); }
  std::int64_t end(Index k) const { return (start[k + 1] * cells - 1) / start.back() + 1; }
};

Raster empty_raster(const std::vector<int>& dim) {
  Raster raster{{0}, 0, {}};
  for (const int d : dim) raster.start.push_back(raster.start.back() + d);
  raster.cells = std::min(raster.start.back(), most_cells);
  raster.cell.assign(raster.cells * raster.cells, Cell::empty);
  return raster;
}

void mark(Raster& raster, Index row, Index column, Cell what) {
  for (std::int64_t i = raster.first(row); i < raster.end(row); ++i) {
    for (std::int64_t j = std::max(i, raster.first(column)); j < raster.end(column); ++j) {
      Cell& cell = raster.cell[i * raster.cells + j];
      cell = std::max(cell, what);
    }
  }
}

Raster raster_of(const elim::OrderedPattern& pattern) {
  Raster raster = empty_raster(pattern.dim);
  for (Index r = 0; r < pattern.rows.size(); ++r) {
    for (const Index i : pattern.rows[r]) {
      for (const Index j : pattern.rows[r]) {
        if (i < j) mark(raster, i, j, Cell::system);
      }
    }
  }
  elim::visit_separators(pattern, elim::elimination_tree(pattern),
                         [&](Index k, std::span<const Index> separator) {
                           mark(raster, k, k, Cell::system);
                           for (const Index j : separator) mark(raster, k, j, Cell::fill);
                         });
  return raster;
}

// Cells of one kind, runs of neighbours as one rectangle.
void draw_cells(cairo_t* page, const Raster& raster, Cell what, double width) {
  for (std::int64_t i = 0; i < raster.cells; ++i) {
    for (std::int64_t j = i; j < raster.cells;) {
      std::int64_t end = j;
      while (end < raster.cells && raster.cell[i * raster.cells + end] == what) ++end;
      if (end > j) {
        cairo_rectangle(page, margin + width * static_cast<double>(j),
                        margin + width * static_cast<double>(i),
                        width * static_cast<double>(end - j), width);
      }
      j = end + 1;
    }
  }
  cairo_fill(page);
}

}  // namespace

void draw_pattern(cairo_t* page, const PageSize& size, const graph::Pattern& pattern,
                  const graph::Order& order, const Heading& heading) {
  draw_heading(page, size, heading);
  draw_legend(page, size, {{path_color, "the system"}, {loop_color, "fill"}});
  const double side = std::min(size.width, size.height) - 2 * margin;
  set_color(page, faint_color);
  cairo_set_line_width(page, 0.5);
  cairo_rectangle(page, margin, margin, side, side);
  cairo_stroke(page);
  const Raster raster = raster_of(elim::ordered(pattern, order));
  if (raster.cells == 0) return;
  const double width = side / static_cast<double>(raster.cells);
  set_color(page, loop_color);
  draw_cells(page, raster, Cell::fill, width);
  set_color(page, path_color);
  draw_cells(page, raster, Cell::system, width);
}

}  // namespace sg::plot
