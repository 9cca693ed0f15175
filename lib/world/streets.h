// A Manhattan world: streets along the lines of a square grid, a metre from pose to pose, a crossing
// every `block` metres. A robot walks them at random, as in Olson, Leonard, Teller: Fast Iterative
// Alignment of Pose Graphs with Poor Initial Estimates (2006), and the graphs called Manhattan and
// City since.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/geometry/se2.h"
#include "lib/graph/graph.h"
#include "lib/world/random.h"

namespace sg::world {

struct Streets {
  Index block = 5;  // metres between crossings
  Index side = 0;   // metres of the square city, a multiple of block; 0: `city_side`
};

// The side of a city in which a walk of so many poses comes by everywhere about twice.
Index city_side(Index poses, Index block);

// The side that is meant: side itself, rounded up to whole blocks, or city_side.
Index side_of(const Streets& streets, Index poses);

struct StreetPose {
  std::int32_t x;
  std::int32_t y;
  std::int32_t heading;  // quarter turns from east, counterclockwise
};
SE2 pose(const StreetPose& at);

// From a corner on; at a crossing straight on (half of the times), left or right; never out of the
// city.
std::vector<StreetPose> street_walk(const Streets& streets, Index poses, Random& random);

}  // namespace sg::world
