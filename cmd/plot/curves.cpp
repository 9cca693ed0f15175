#include "cmd/plot/curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "cmd/common/table.h"
#include "cmd/plot/axes.h"
#include "cmd/plot/picture.h"
#include "cmd/plot/words.h"

namespace sg::plot {
namespace {

constexpr double left = 70, right = 16, bottom = 40;

// Brewer's Dark2, which people who do not tell red from green can tell apart.
constexpr std::array<Color, 8> colors{{{0.11, 0.62, 0.47},
                                       {0.85, 0.37, 0.01},
                                       {0.46, 0.44, 0.70},
                                       {0.91, 0.16, 0.54},
                                       {0.40, 0.65, 0.12},
                                       {0.90, 0.67, 0.01},
                                       {0.65, 0.46, 0.11},
                                       {0.40, 0.40, 0.40}}};

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
  double step = round_step(axis.low, axis.high, 6);
  if (axis.log) step = std::max(1.0, std::ceil(step));
  std::vector<double> result = round_numbers(axis.low, axis.high, step);
  if (axis.log)
    std::ranges::transform(result, result.begin(), [](double x) { return std::pow(10, x); });
  return result;
}

// "1000", but "1e6" of powers of ten beyond that.
std::string label(const Axis& axis, double tick) {
  const double power = std::round(std::log10(std::abs(tick)));
  if (axis.log && std::abs(power) > 4) return "1e" + cmd::rounded(power, 6);
  return cmd::rounded(tick, 6);
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
    words(x(tick), y.from + 14, 0.5, label(x, tick));
  }
  for (const double tick : ticks(y)) {
    line(x.from, y(tick), x.to, y(tick));
    words(x.from - 5, y(tick) + 3, 1, label(y, tick));
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

// Its colour and, where colours come round again, its dashes.
void set_look(cairo_t* page, std::size_t k) {
  set_color(page, colors[k % colors.size()]);
  const std::size_t turn = k / colors.size();
  const double dash = 2.0 * static_cast<double>(turn);
  const std::array<double, 2> dashes{dash, 3};
  cairo_set_dash(page, dashes.data(), dash > 0 ? 2 : 0, 0);
}

constexpr double legend_font = 9, legend_line = 11, sample = 12, gap = 12;
constexpr std::size_t most_lines = 8;

// How many of the curves' names stand in each line above the picture.
std::vector<std::size_t> legend_lines(cairo_t* page, const PageSize& size, const Curves& curves) {
  cairo_set_font_size(page, legend_font);
  std::vector<std::size_t> lines;
  double x = 0;
  for (const Curve& curve : curves.curves) {
    const double width = sample + 4 + width_of(page, curve.name) + gap;
    if (lines.empty() || (lines.back() > 0 && x + width > size.width - left - right)) {
      if (lines.size() == most_lines) break;
      lines.push_back(0);
      x = 0;
    }
    ++lines.back();
    x += width;
  }
  if (lines.empty()) lines.push_back(0);
  return lines;
}

void draw_legend(cairo_t* page, const Curves& curves, const std::vector<std::size_t>& lines) {
  cairo_set_font_size(page, legend_font);
  cairo_set_line_width(page, 2);
  std::size_t k = 0;
  double y = 20;
  for (const std::size_t count : lines) {
    double x = left;
    for (std::size_t i = 0; i < count; ++i, ++k) {
      set_look(page, k);
      cairo_move_to(page, x, y);
      cairo_line_to(page, x + sample, y);
      cairo_stroke(page);
      set_color(page, {0, 0, 0});
      cairo_move_to(page, x + sample + 4, y + 3);
      cairo_show_text(page, curves.curves[k].name.c_str());
      x += sample + 4 + width_of(page, curves.curves[k].name) + gap;
    }
    y += legend_line;
  }
  cairo_set_dash(page, nullptr, 0, 0);
  if (k == curves.curves.size()) return;
  const std::string more = "and " + std::to_string(curves.curves.size() - k) + " more";
  cairo_move_to(page, 4, y - legend_line + 3);
  cairo_show_text(page, more.c_str());
}

}  // namespace

void draw_curves(cairo_t* page, const PageSize& size, const Curves& curves, const LogAxes& log) {
  const std::vector<std::size_t> lines = legend_lines(page, size, curves);
  const double top = 19 + legend_line * static_cast<double>(lines.size());
  const Axis x = axis(curves, &Point::x, log, log.x, left, size.width - right);
  const Axis y = axis(curves, &Point::y, log, log.y, size.height - bottom, top);
  draw_axes(page, size, x, y, curves.x);
  cairo_set_line_width(page, 1.5);
  cairo_set_line_cap(page, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(page, CAIRO_LINE_JOIN_ROUND);
  for (std::size_t k = 0; k < curves.curves.size(); ++k) {
    set_look(page, k);
    draw_curve(page, thinned(curves.curves[k], x, y), x, y);
  }
  draw_legend(page, curves, lines);
  draw_heading(page, size, {curves.title, " "});
}

}  // namespace sg::plot
