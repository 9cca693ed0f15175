#include "cmd/plot/axes.h"

#include <algorithm>
#include <cmath>

#include "cmd/common/table.h"
#include "cmd/plot/picture.h"

namespace sg::plot {
namespace {

constexpr double tick = 3, font = 7;
constexpr Color ink{0, 0, 0};
constexpr Color grey{0.35, 0.35, 0.35};

// "x", "-z", or nothing for a direction between.
std::string axis_name(const Eigen::RowVector3d& direction) {
  for (int k = 0; k < 3; ++k) {
    std::string name(1, static_cast<char>('x' + k));
    if (direction[k] > 1 - 1e-9) return name;
    if (direction[k] < -1 + 1e-9) return "-" + name;
  }
  return "";
}

// Numbers on a side of the page that is `length` points long: the middle of them is at `middle` metres.
std::vector<double> numbers_along(double length, double middle, double scale) {
  const double half = (length / 2 - margin) / scale;
  const double low = middle - half, high = middle + half;
  return round_numbers(low, high, round_step(low, high, std::clamp(length / 80, 2.0, 10.0)));
}

// Beside the page's edge, its middle at x, y; upwards where the axis goes up.
void show_number(cairo_t* page, double x, double y, bool upwards, const std::string& words) {
  cairo_save(page);
  cairo_translate(page, x, y);
  if (upwards) cairo_rotate(page, -M_PI / 2);
  cairo_move_to(page, -width_of(page, words) / 2, 0);
  cairo_show_text(page, words.c_str());
  cairo_restore(page);
}

}  // namespace

// The largest of 1, 2, 5 times a power of ten that is no longer than `length`.
double round_length(double length) {
  const double power = std::pow(10, std::floor(std::log10(length)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= length) return digit * power;
  }
  return power;
}

double round_step(double low, double high, double about) {
  double step = std::pow(10, std::floor(std::log10((high - low) / about)));
  for (const double digit : {2.0, 2.5, 2.0}) {  // 2, 5 and 10 times
    if ((high - low) / step > about) step *= digit;
  }
  return step;
}

std::vector<double> round_numbers(double low, double high, double step) {
  std::vector<double> result;
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
    result.push_back(k * step + 0.0);
  return result;
}

double width_of(cairo_t* page, const std::string& words) {
  cairo_text_extents_t extents;
  cairo_text_extents(page, words.c_str(), &extents);
  return extents.x_advance;
}

void draw_scale_bar(cairo_t* page, const PageSize& size, double scale) {
  const double metres = round_length(size.width / 5 / scale);
  const double y = size.height - margin / 3;
  set_color(page, {0, 0, 0});
  cairo_set_line_width(page, 1.5);
  cairo_move_to(page, margin, y);
  cairo_line_to(page, margin + scale * metres, y);
  cairo_stroke(page);
  std::string label = std::to_string(metres);
  label.erase(label.find_last_not_of('0') + 1);
  if (label.back() == '.') label.pop_back();
  cairo_set_font_size(page, 10);
  cairo_move_to(page, margin + scale * metres + 4, y + 3);
  cairo_show_text(page, (label + " m").c_str());
}

void draw_map_axes(cairo_t* page, const PageSize& size, const View& view,
                   const Projection& project) {
  const double left = margin, bottom = size.height - margin;
  set_color(page, grey);
  cairo_set_font_size(page, font);
  cairo_set_line_width(page, 0.5);
  for (const double x : numbers_along(size.width, project.middle.x, project.scale)) {
    const double at = project({x, 0}).x;
    cairo_move_to(page, at, bottom);
    cairo_line_to(page, at, bottom + tick);
    show_number(page, at, bottom + tick + font - 1, false, cmd::rounded(x, 6));
  }
  for (const double y : numbers_along(size.height, project.middle.y, project.scale)) {
    const double at = project({0, y}).y;
    cairo_move_to(page, left, at);
    cairo_line_to(page, left - tick, at);
    show_number(page, left - tick - 2, at, true, cmd::rounded(y, 6));
  }
  cairo_stroke(page);
  cairo_move_to(page, size.width - margin + 4, bottom + 2);
  cairo_show_text(page, axis_name(view.row(0)).c_str());
  cairo_move_to(page, tick, margin);
  cairo_show_text(page, axis_name(view.row(1)).c_str());
}

}  // namespace sg::plot
