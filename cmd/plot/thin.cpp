#include "cmd/plot/thin.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace sg::plot {
namespace {

// 16 bits a coordinate: a page has at most 20,000 points, cells are half a point or more.
std::uint64_t cell(const Point& p, double size) {
  const auto count = [size](double x) {
    return static_cast<std::uint64_t>(std::clamp(x / size, 0.0, 65535.0));
  };
  return count(p.x) << 16 | count(p.y);
}

std::vector<Segment> first_of_each(const std::vector<Segment>& segments,
                                   const std::vector<Point>& at, double size) {
  std::vector<std::pair<std::uint64_t, std::size_t>> keys;
  keys.reserve(segments.size());
  for (const auto& [from, to] : segments) {
    const auto [low, high] = std::minmax({cell(at[from], size), cell(at[to], size)});
    keys.emplace_back(low << 32 | high, keys.size());
  }
  std::ranges::sort(keys);
  const auto rest = std::ranges::unique(keys, {}, &std::pair<std::uint64_t, std::size_t>::first);
  keys.erase(rest.begin(), rest.end());
  std::ranges::sort(keys, {}, &std::pair<std::uint64_t, std::size_t>::second);
  std::vector<Segment> kept;
  kept.reserve(keys.size());
  for (const auto& [key, k] : keys) kept.push_back(segments[k]);
  return kept;
}

}  // namespace

std::vector<Segment> thinned(std::vector<Segment> segments, const std::vector<Point>& at,
                             std::size_t most) {
  for (double size = 0.5; segments.size() > most && size < 65536; size *= 2)
    segments = first_of_each(segments, at, size);
  return segments;
}

}  // namespace sg::plot
