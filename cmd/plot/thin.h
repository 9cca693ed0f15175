// Fewer lines and dots where nobody could tell them apart: what keeps pictures of large graphs small, and quick to draw.
#pragma once

#include <cstddef>
#include <vector>

#include "lib/graph/lists.h"

namespace sg::plot {

struct Point {
  double x, y;
};

// From one point of the page to another, by their numbers; to itself: a dot.
struct Segment {
  Index from, to;
};

// Where there are more than `most`: of all that join the same two cells of the page the first, in the order given. Cells
// begin at half a point and double until no more than `most` stay.
std::vector<Segment> thinned(std::vector<Segment> segments, const std::vector<Point>& at,
                             std::size_t most = 40000);

}  // namespace sg::plot
