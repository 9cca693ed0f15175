// What somebody wants of a graph, and which of its variants has it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "cmd/report/variants.h"

namespace sg::report {

enum class Aim : std::uint8_t {
  faster,  // so many times as fast: in seconds of an elimination, in EC where those are not known
  ate,     // a trajectory error of no more than this
  sigma_part,  // a mean sigma of no more than so many times that of the whole graph
};

struct Wish {
  Aim aim = Aim::sigma_part;
  double value = 1.05;
  std::string text = "sigma-part=1.05";  // as it was said
};
// "faster=2", "ate=0.05", "sigma-part=1.05". Throws a usage Error for anything else.
Wish parse_wish(const std::string& text);

// Compared with the first, the whole graph in the first ordering.
double times_as_fast(const Variant& variant, const Variant& whole);
std::optional<double> sigma_part(const Variant& variant, const Variant& whole);

struct Advice {
  std::string sentence;
  bool granted = false;
  std::optional<std::size_t> variant = {};
};
// Of those that grant it the one that loses least (faster), or costs least (ate, sigma_part); where none does, the nearest.
Advice advise(const Wish& wish, std::span<const Variant> variants);

}  // namespace sg::report
