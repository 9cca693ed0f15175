#include "cmd/plot/thin.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <unordered_set>
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

// Nothing where they are more than `most`, which is found out early.
std::optional<std::vector<Segment>> first_of_each(const std::vector<Segment>& segments,
                                                  const std::vector<Point>& at, double size,
                                                  std::size_t most) {
  std::unordered_set<std::uint64_t> taken;
  taken.reserve(2 * most);
  std::vector<Segment> kept;
  for (const Segment& segment : segments) {
    const auto [low, high] =
        std::minmax({cell(at[segment.from], size), cell(at[segment.to], size)});
    if (!taken.insert(low << 32 | high).second) continue;
    if (kept.size() == most) return std::nullopt;
    kept.push_back(segment);
  }
  return kept;
}

}  // namespace

std::vector<Segment> thinned(std::vector<Segment> segments, const std::vector<Point>& at,
                             std::size_t most) {
  for (double size = 0.5; segments.size() > most && size < 65536; size *= 2) {
    if (auto kept = first_of_each(segments, at, size, most)) return std::move(*kept);
  }
  return segments;
}

}  // namespace sg::plot
