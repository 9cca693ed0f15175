#include "cmd/report/wish.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "cmd/common/table.h"
#include "lib/text/error.h"
#include "lib/text/words.h"

namespace sg::report {
namespace {

constexpr double none = std::numeric_limits<double>::infinity();

struct Named {
  Aim aim;
  std::string_view name;
};
constexpr std::array aims{Named{Aim::faster, "faster"}, Named{Aim::ate, "ate"},
                          Named{Aim::sigma_part, "sigma-part"}};

double loss(const Variant& variant, const Variant& whole) {
  return std::max(1.0, sigma_part(variant, whole).value_or(&variant == &whole ? 1 : none));
}

// How far from granting the wish: 0 where it does.
double distance(const Wish& wish, const Variant& variant, const Variant& whole) {
  switch (wish.aim) {
    case Aim::faster:
      return std::max(0.0, wish.value - times_as_fast(variant, whole));
    case Aim::ate:
      return std::max(0.0, variant.ate.value_or(none) - wish.value);
    case Aim::sigma_part:
      break;
  }
  return std::max(0.0, loss(variant, whole) - wish.value);
}

// What to do, in an imperative.
std::string recipe(const Variant& variant, const Variant& whole) {
  std::string text;
  if (variant.policy == "full") {
    if (variant.order == whole.order)
      return "Leave the graph as it is, in the order of " + whole.order;
    text = "Keep the whole graph";
  } else {
    text = "Prune it by " + variant.policy;
    if (variant.rate) text += " at rate " + std::to_string(*variant.rate);
  }
  return text + ", and eliminate it in the order of " + variant.order;
}

std::string consequence(const Variant& variant, const Variant& whole) {
  std::string text = cmd::rounded(times_as_fast(variant, whole), 3) + " times as fast";
  text += variant.median_s && whole.median_s
              ? " (" + cmd::rounded(1e3 * *variant.median_s, 3) + " ms instead of " +
                    cmd::rounded(1e3 * *whole.median_s, 3) + " an elimination, "
              : " by EC (";
  text += "EC " + elim::to_string(variant.ec) + " instead of " + elim::to_string(whole.ec) + ")";
  if (variant.policy == "full") return text + "; nothing is lost";
  if (const auto part = sigma_part(variant, whole))
    text += "; mean sigma " + cmd::rounded(*part, 3) + " times that of the whole graph";
  if (variant.ate) text += "; ATE " + cmd::rounded(*variant.ate, 3);
  return text;
}

}  // namespace

Wish parse_wish(const std::string& text) {
  const auto equals = std::min(text.find('='), text.size());
  const auto aim = std::ranges::find(aims, text.substr(0, equals), &Named::name);
  const auto value = text::parse<double>(text.substr(std::min(equals + 1, text.size())));
  if (aim == aims.end() || !value || !std::isfinite(*value) || *value <= 0)
    throw text::usage_error(
        "--want is faster=TIMES, ate=ERROR or sigma-part=TIMES, with a number "
        "above 0, not '" +
        text + "'");
  return {aim->aim, *value, text};
}

double times_as_fast(const Variant& variant, const Variant& whole) {
  if (variant.median_s && whole.median_s && *variant.median_s > 0)
    return *whole.median_s / *variant.median_s;
  return variant.ec > 0 ? elim::to_double(whole.ec) / elim::to_double(variant.ec) : 1;
}

std::optional<double> sigma_part(const Variant& variant, const Variant& whole) {
  if (variant.policy == "full") return 1;
  if (!variant.sigma || !whole.sigma || *whole.sigma <= 0) return std::nullopt;
  return *variant.sigma / *whole.sigma;
}

Advice advise(const Wish& wish, std::span<const Variant> variants) {
  if (variants.empty()) return {"Nothing was measured", false, {}};
  const Variant& whole = variants.front();
  // A policy that has left all there is none. Nearest to the wish; then, who wants speed, the least lost and the most kept; else the fastest.
  const auto key = [&](const Variant& variant) {
    const double off = distance(wish, variant, whole);
    const double slow = 1 / times_as_fast(variant, whole);
    const bool speed = wish.aim == Aim::faster;
    const bool same = variant.edges == whole.edges && variant.policy != whole.policy;
    return std::tuple(same, off, speed ? loss(variant, whole) : slow, -variant.edges, slow);
  };
  const auto best = std::ranges::min_element(variants, {}, key);
  const bool granted = distance(wish, *best, whole) == 0;
  std::string sentence = recipe(*best, whole) + ": " + consequence(*best, whole) + ".";
  if (!granted) sentence = "Nothing that was tried has " + wish.text + "; the nearest: " + sentence;
  return {std::move(sentence), granted, static_cast<std::size_t>(best - variants.begin())};
}

}  // namespace sg::report
