#include "lib/score/fill.h"

#include <algorithm>

namespace sg::score {
namespace {

// Where odometry leads from the nearest kept pose of one side.
struct Led {
  SE3 pose;
  int steps;
};
using Place = std::optional<Led>;

std::vector<Place> kept_places(const Trajectory& kept, const Odometry& odometry) {
  std::vector<Place> places(odometry.id.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto found = std::ranges::lower_bound(kept.id, odometry.id[k]);
    if (found != kept.id.end() && *found == odometry.id[k])
      places[k] = {kept.pose[found - kept.id.begin()], 0};
  }
  return places;
}

std::vector<Place> led_onwards(std::vector<Place> places, const Odometry& odometry) {
  for (std::size_t k = 1; k < places.size(); ++k) {
    const Place& before = places[k - 1];
    if (!places[k] && before && odometry.step[k])
      places[k] = {compose(before->pose, *odometry.step[k]), before->steps + 1};
  }
  return places;
}

std::vector<Place> led_back(std::vector<Place> places, const Odometry& odometry) {
  for (std::size_t k = places.size(); k-- > 1;) {
    const Place& behind = places[k];
    if (!places[k - 1] && behind && odometry.step[k])
      places[k - 1] = {compose(behind->pose, inverse(*odometry.step[k])), behind->steps + 1};
  }
  return places;
}

SE3 between_places(const Led& a, const Led& b) {
  if (a.steps == 0) return a.pose;
  const double part = static_cast<double>(a.steps) / (a.steps + b.steps);
  return compose(a.pose, geometry::exp(Vector6d(part * log(between(a.pose, b.pose)))));
}

}  // namespace

Trajectory filled(const Trajectory& kept, const Odometry& odometry) {
  const std::vector<Place> places = kept_places(kept, odometry);
  const auto before = led_onwards(places, odometry), behind = led_back(places, odometry);
  Trajectory result;
  const auto add = [&](Id id, const SE3& pose) {
    result.id.push_back(id);
    result.pose.push_back(pose);
  };
  std::size_t next = 0;  // of the kept poses, some of which odometry may not know
  for (std::size_t k = 0; k < places.size(); ++k) {
    for (; next < kept.id.size() && kept.id[next] <= odometry.id[k]; ++next) {
      if (kept.id[next] < odometry.id[k]) add(kept.id[next], kept.pose[next]);
    }
    if (before[k] && behind[k]) {
      add(odometry.id[k], between_places(*before[k], *behind[k]));
    } else if (before[k] || behind[k]) {
      add(odometry.id[k], (before[k] ? before[k] : behind[k])->pose);
    }
  }
  for (; next < kept.id.size(); ++next) add(kept.id[next], kept.pose[next]);
  return result;
}

}  // namespace sg::score
