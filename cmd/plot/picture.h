// A picture drawn with Cairo, as the bytes of a file.
#pragma once

#include <cairo.h>

#include <functional>
#include <string>

namespace sg::plot {

enum class PictureFormat { svg, png, pdf };

// Told by the ending of a file's name; svg where there is no name. Throws a usage Error for an
// ending of another kind.
PictureFormat picture_format(const std::string& path);

// A page of width x height points (1/72 inch; for png, pixels), white to begin with, the origin at
// the top left. Throws a computation Error when Cairo gives up.
std::string picture(PictureFormat format, double width, double height,
                    const std::function<void(cairo_t*)>& draw);

struct Color {
  double red, green, blue;
};
inline void set_color(cairo_t* page, const Color& color, double opacity = 1) {
  cairo_set_source_rgba(page, color.red, color.green, color.blue, opacity);
}

// What things look like in every picture.
constexpr Color path_color{0.12, 0.30, 0.55};
constexpr Color loop_color{0.85, 0.45, 0.10};
constexpr Color landmark_color{0.15, 0.50, 0.25};
constexpr Color faint_color{0.60, 0.60, 0.60};
constexpr Color overlay_color{0.49, 0.18, 0.56};
constexpr Color error_color{0.91, 0.16, 0.54};

}  // namespace sg::plot
