#include "lib/factor/kernel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sg::factor {
namespace {

double squared(double x) {
  return x * x;
}

constexpr std::array<KernelShape, 5> shapes{{
    {"huber", [](double s, double w) { return s <= w * w ? s : 2 * w * std::sqrt(s) - w * w; },
     [](double s, double w) { return s <= w * w ? 1 : w / std::sqrt(s); }},
    {"cauchy", [](double s, double w) { return w * w * std::log1p(s / (w * w)); },
     [](double s, double w) { return 1 / (1 + s / (w * w)); }},
    {"tukey",
     [](double s, double w) {
       return w * w / 3 * (s <= w * w ? 1 - std::pow(1 - s / (w * w), 3) : 1);
     },
     [](double s, double w) { return s <= w * w ? squared(1 - s / (w * w)) : 0; }},
    {"geman-mcclure", [](double s, double w) { return w * w * (s / (w * w + s)); },
     [](double s, double w) { return squared(w * w / (w * w + s)); }},
    {"dcs",
     [](double s, double w) { return s <= w * w ? s : w * w * (3 - 4 * (w * w / (w * w + s))); },
     [](double s, double w) { return s <= w * w ? 1 : squared(2 * (w * w / (w * w + s))); }},
}};

}  // namespace

std::span<const KernelShape> kernel_shapes() {
  return shapes;
}

const KernelShape* find_kernel_shape(std::string_view name) {
  const auto shape = std::ranges::find(shapes, name, &KernelShape::name);
  return shape == shapes.end() ? nullptr : &*shape;
}

}  // namespace sg::factor
