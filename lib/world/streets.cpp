#include "lib/world/streets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace sg::world {
namespace {

constexpr std::array<std::int32_t, 4> east{1, 0, -1, 0}, north{0, 1, 0, -1};

StreetPose ahead(StreetPose at, int turn) {
  at.heading = (at.heading + turn) & 3;
  at.x += east[at.heading];
  at.y += north[at.heading];
  return at;
}

bool inside(const StreetPose& at, Index side) {
  return at.x >= 0 && at.y >= 0 && at.x <= side && at.y <= side;
}

int turn_at_crossing(Random& random) {
  constexpr std::array turns{0, 0, 1, 3};
  return turns[below(random, 4)];
}

}  // namespace

Index city_side(Index poses, Index block) {
  const double metres = std::sqrt(static_cast<double>(poses) * block / 4);
  return block * static_cast<Index>(std::max(1.0, std::round(metres / block)));
}

Index side_of(const Streets& streets, Index poses) {
  if (streets.side == 0) return city_side(poses, streets.block);
  return (streets.side + streets.block - 1) / streets.block * streets.block;
}

SE2 pose(const StreetPose& at) {
  constexpr double quarter = std::numbers::pi / 2;
  constexpr std::array angles{0.0, quarter, 2 * quarter, -quarter};
  return {static_cast<double>(at.x), static_cast<double>(at.y), angles[at.heading]};
}

std::vector<StreetPose> street_walk(const Streets& streets, Index poses, Random& random) {
  const Index side = side_of(streets, poses);
  std::vector<StreetPose> walk;
  walk.reserve(poses);
  StreetPose at{0, 0, 0};
  for (Index k = 0; k < poses; ++k) {
    walk.push_back(at);
    const bool crossing = at.x % streets.block == 0 && at.y % streets.block == 0;
    StreetPose next = ahead(at, crossing ? turn_at_crossing(random) : 0);
    while (!inside(next, side)) next = ahead(at, turn_at_crossing(random));
    at = next;
  }
  return walk;
}

}  // namespace sg::world
