#include "cmd/plot/curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "cmd/common/table.h"
#include "cmd/plot/picture.h"
#include "cmd/plot/words.h"
#include "lib/text/error.h"
#include "lib/text/words.h"

namespace sg::plot {
namespace {

constexpr double left = 70, right = 16, top = 30, bottom = 40;

// Brewer's Dark2, which people who do not tell red from green can tell apart.
constexpr std::array<Color, 8> colors{{{0.11, 0.62, 0.47},
                                       {0.85, 0.37, 0.01},
                                       {0.46, 0.44, 0.70},
                                       {0.91, 0.16, 0.54},
                                       {0.40, 0.65, 0.12},
                                       {0.90, 0.67, 0.01},
                                       {0.65, 0.46, 0.11},
                                       {0.40, 0.40, 0.40}}};

using Cells = std::vector<std::string>;

Cells cells_of(std::string_view line) {
  Cells cells;
  for (std::size_t at = 0; at <= line.size();) {
    const auto end = std::min(line.find('\t', at), line.size());
    cells.emplace_back(line.substr(at, end - at));
    at = end + 1;
  }
  return cells;
}

std::optional<double> number(const std::string& cell) {
  const auto value = text::parse<double>(cell);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::vector<Cells> rows_of(std::string_view text, const std::string& file) {
  std::vector<Cells> rows;
  std::size_t line = 0;
  while (!text.empty()) {
    ++line;
    rows.push_back(cells_of(text::next_line(text)));
    if (rows.back().size() != rows.front().size())
      throw text::input_error(file, line,
                              std::to_string(rows.back().size()) + " cells, and the header has " +
                                  std::to_string(rows.front().size()));
  }
  return rows;
}

struct Axis {
  double low, high;  // of the values, or of their logarithms
  double from, to;   // on the page
  bool log;

  double value(double x) const { return log ? std::log10(x) : x; }
  bool shows(double x) const { return !log || x > 0; }
  double operator()(double x) const { return from + (value(x) - low) / (high - low) * (to - from); }
};

Axis axis(const Curves& curves, double Point::*coordinate, const LogAxes& log, bool is_log,
          double from, double to) {
  Axis result{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
              from, to, is_log};
  for (const Curve& curve : curves.curves) {
    for (const Point& p : curve.points) {
      if ((log.x && p.x <= 0) || (log.y && p.y <= 0)) continue;
      result.low = std::min(result.low, result.value(p.*coordinate));
      result.high = std::max(result.high, result.value(p.*coordinate));
    }
  }
  if (result.low > result.high) result.low = result.high = 0;
  if (result.low == result.high) result.low -= 0.5, result.high += 0.5;
  return result;
}

// Round numbers along an axis; of a logarithmic one powers of ten.
std::vector<double> ticks(const Axis& axis) {
  constexpr double about = 6;
  double step = std::pow(10, std::floor(std::log10((axis.high - axis.low) / about)));
  for (const double digit : {2.0, 2.5, 2.0}) {  // 2, 5 and 10 times
    if ((axis.high - axis.low) / step > about) step *= digit;
  }
  if (axis.log) step = std::max(1.0, std::ceil(step));
  std::vector<double> result;
  for (double k = std::ceil(axis.low / step - 1e-9); k * step <= axis.high + 1e-9 * step; ++k)
    result.push_back(axis.log ? std::pow(10, k * step) : k * step + 0.0);
  return result;
}

double width_of(cairo_t* page, const std::string& words) {
  cairo_text_extents_t extents;
  cairo_text_extents(page, words.c_str(), &extents);
  return extents.x_advance;
}

void draw_axes(cairo_t* page, const PageSize& size, const Axis& x, const Axis& y,
               const std::string& name) {
  cairo_set_line_width(page, 0.5);
  cairo_set_font_size(page, 10);
  const auto line = [&](double x1, double y1, double x2, double y2) {
    set_color(page, faint_color, 0.5);
    cairo_move_to(page, x1, y1);
    cairo_line_to(page, x2, y2);
    cairo_stroke(page);
  };
  const auto words = [&](double at, double below, double part, const std::string& text) {
    set_color(page, {0, 0, 0});
    cairo_move_to(page, at - part * width_of(page, text), below);
    cairo_show_text(page, text.c_str());
  };
  for (const double tick : ticks(x)) {
    line(x(tick), y.from, x(tick), y.to);
    words(x(tick), y.from + 14, 0.5, cmd::rounded(tick, 6));
  }
  for (const double tick : ticks(y)) {
    line(x.from, y(tick), x.to, y(tick));
    words(x.from - 5, y(tick) + 3, 1, cmd::rounded(tick, 6));
  }
  words(x.to, size.height - 8, 1, name);
}

void draw_curve(cairo_t* page, const Curve& curve, const Axis& x, const Axis& y) {
  const Point* before = nullptr;
  for (const Point& p : curve.points) {
    if (!x.shows(p.x) || !y.shows(p.y)) continue;
    if (before) {
      cairo_line_to(page, x(p.x), y(p.y));
    } else {
      cairo_move_to(page, x(p.x), y(p.y));
    }
    before = &p;
  }
  if (curve.points.size() == 1 && before) cairo_close_path(page);  // of no length: a dot
  cairo_stroke(page);
}

// Of a long curve, points that are nearer to each other than can be seen.
Curve thinned(const Curve& curve, const Axis& x, const Axis& y) {
  Curve result{curve.name, {}};
  Point last{0, 0};
  for (const Point& p : curve.points) {
    if (!x.shows(p.x) || !y.shows(p.y)) continue;
    const Point at{x(p.x), y(p.y)};
    if (!result.points.empty() && std::hypot(at.x - last.x, at.y - last.y) < 0.3) continue;
    result.points.push_back(p);
    last = at;
  }
  return result;
}

}  // namespace

Curves read_curves(std::string_view text, const std::string& file) {
  const std::vector<Cells> rows = rows_of(text, file);
  if (rows.size() < 2)
    throw text::input_error(file, 0, "no table: a header line and a row at least");
  std::vector<std::size_t> numbers, words;
  for (std::size_t k = 0; k < rows.front().size(); ++k) {
    bool any = false, all = true;
    for (auto row = rows.begin() + 1; row != rows.end(); ++row) {
      any = any || number((*row)[k]);
      all = all && ((*row)[k].empty() || number((*row)[k]));
    }
    if (!all) words.push_back(k);
    if (all && any) numbers.push_back(k);
  }
  if (numbers.size() < 2)
    throw text::input_error(file, 1, "curves want two columns of numbers, the first to the right");
  Curves result{rows.front()[numbers.front()], {}};
  std::map<std::string, std::size_t> known;
  for (auto row = rows.begin() + 1; row != rows.end(); ++row) {
    const auto x = number((*row)[numbers.front()]);
    for (auto column = numbers.begin() + 1; column != numbers.end(); ++column) {
      const auto y = number((*row)[*column]);
      if (!x || !y) continue;
      std::string name = rows.front()[*column];
      for (const std::size_t word : words) name += " " + (*row)[word];
      const auto [place, fresh] = known.emplace(name, result.curves.size());
      if (fresh) result.curves.push_back({name, {}});
      result.curves[place->second].points.push_back({*x, *y});
    }
  }
  return result;
}

void draw_curves(cairo_t* page, const PageSize& size, const Curves& curves, const LogAxes& log) {
  const Axis x = axis(curves, &Point::x, log, log.x, left, size.width - right);
  const Axis y = axis(curves, &Point::y, log, log.y, size.height - bottom, top);
  draw_axes(page, size, x, y, curves.x);
  cairo_set_line_width(page, 1.5);
  cairo_set_line_cap(page, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(page, CAIRO_LINE_JOIN_ROUND);
  double legend = left;
  for (std::size_t k = 0; k < curves.curves.size(); ++k) {
    set_color(page, colors[k % colors.size()]);
    draw_curve(page, thinned(curves.curves[k], x, y), x, y);
    cairo_arc(page, legend + 4, top / 2, 4, 0, 2 * M_PI);
    cairo_fill(page);
    set_color(page, {0, 0, 0});
    cairo_move_to(page, legend + 12, top / 2 + 3);
    cairo_show_text(page, curves.curves[k].name.c_str());
    legend += 24 + width_of(page, curves.curves[k].name);
  }
}

}  // namespace sg::plot
