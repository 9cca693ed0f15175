// A trajectory of which some poses were dropped, with all of them again: so that what keeps few poses and what keeps all
// are judged over the same.
#pragma once

#include <optional>
#include <vector>

#include "lib/score/trajectory.h"

namespace sg::score {

// What odometry measured, of all poses that there once were.
struct Odometry {
  std::vector<Id> id;  // ascending
  std::vector<std::optional<SE3>>
      step;  // from the pose before, in its frame; nothing where a segment begins
};

// A dropped pose stands where odometry leads from the kept pose before it and, backwards, from the one behind it: on the
// way from the one place to the other (a screw motion), in proportion to the steps that lead there, which is where least
// squares puts it if all steps are alike and nothing turns. At the end of a segment one of them has to do; where a
// segment has kept none, its poses stay out.
Trajectory filled(const Trajectory& kept, const Odometry& odometry);

}  // namespace sg::score
