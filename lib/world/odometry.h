// The motion of a robot along its true poses, as it measures it from each pose to the next.
#pragma once

#include <functional>

#include "lib/world/lines.h"

namespace sg::world {

// Of each world there are two graphs: the noisy one, and the exact one with the same edges and the
// same information, but true poses and true measurements.
enum class Copy { noisy, exact };

// Begins the line of a false edge, which the exact copy has as a comment: so the lines of the two are the same in number,
// and those that begin so in one are what is false in the other.
inline void begin_false(Copy copy, Out& out) {
  if (copy == Copy::exact) out.buffer += "# false ";
}

// Where the poses of the noisy graph start: composed from its odometry, or where they truly are.
enum class Guess { odometry, truth };

template <class Pose>  // SE2 or SE3
struct Odometry {
  std::function<Pose(Index)> truth;
  PoseNoise noise;
  Copy copy;
  Random random;
  Pose last;  // true pose where the next motion begins
};

// Odometry from pose 0 on. Two of the same world tell the same motions.
template <class Pose>
Odometry<Pose> odometry(std::function<Pose(Index)> truth, const PoseNoise& noise, Copy copy,
                        std::uint64_t seed) {
  const Pose first = truth(0);
  return {std::move(truth), noise, copy, random_stream(seed, Stream::odometry), first};
}

// The measured motion from pose k-1 to pose k; to be asked for k = 1, 2, ... in turn.
template <class Pose>
Pose measured_motion(Odometry<Pose>& odometry, Index k) {
  const Pose next = odometry.truth(k);
  const Pose z = geometry::between(odometry.last, next);
  odometry.last = next;
  if (odometry.copy == Copy::exact) return rounded(z);
  return disturbed(z, odometry.noise, odometry.random);
}

// Calls use(k, pose) for k = 0, 1, ... with what stands in the VERTEX lines: true poses in the exact
// copy and with Guess::truth, otherwise the sum of the measured motions.
template <class Pose, class Use>
void for_each_estimate(Index poses, Odometry<Pose> odometry, Guess guess, const Use& use) {
  const bool exact = odometry.copy == Copy::exact || guess == Guess::truth;
  Pose pose = rounded(odometry.last);
  for (Index k = 0; k < poses; ++k) {
    if (k > 0)
      pose = rounded(exact ? odometry.truth(k)
                           : geometry::compose(pose, measured_motion(odometry, k)));
    use(k, pose);
  }
}

}  // namespace sg::world
