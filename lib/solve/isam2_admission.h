// Which measurements a budget of elimination complexity holds: all poses stay, and what is offered at a step (closures and
// observations; never odometry) is admitted by its gain per rise of EC_BT (isam2_admit.h), the best first, while the
// tree's EC_BT stays within the budget. Where there is no room for one, those that were admitted at the lowest rate are
// given back, each at what it is worth by now, as long as that is less than the newcomer's rate. So the budget holds the
// best set seen so far, as near as greedy gets.
//
// A new landmark is one offer with the observations that it enters by: the first, the last and one between, or min_obs
// of them; refused, it is offered again with its next. What tells of no pose, as the only observation of a landmark does,
// is refused. Once a landmark is in, its further observations are offers; it is given back with all of them, for good.
//
// Source: Frey, Steiner, How, Complexity analysis and efficient measurement selection primitives (2019), conclusions.
#pragma once

#include <optional>
#include <vector>

#include "lib/solve/isam2_replay.h"

namespace sg::solve {

struct Offer {
  Index vertex = -1;         // a landmark that would enter with it; -1: none
  std::vector<Index> edges;  // of a landmark, ascending
};

struct Admission {
  struct Held {
    double rate;        // gain per rise of EC_BT, when it was last looked at
    double cost;        // that rise
    Index edge;         // -1:
    Index landmark;     // the variable, with all its edges
    Index looked = -1;  // before which update that was; as long as there is none, the rate is that
  };
  std::vector<Held> held;    // a heap, the lowest rate on top; edges that have left since included
  std::vector<Index> place;  // by variable (isam2_admit.h)
  Index offered = 0;         // edges so far
  Index admitted = 0;        // of them
  Index returned = 0;        // given back since
  double choosing = 0;       // seconds so far of pricing and choosing
};

Admission make_admission(const Isam2Replay& replay);

// Takes what is offered out of what enters at step k: its vertices and edges. What has to stay for the step's pose to be
// determined stays.
std::vector<Offer> take_offers(const Isam2Replay& replay, Index k, int min_obs,
                               std::vector<Index>& vertices, std::vector<Index>& edges);

// After the step's update without them: admits and gives back, in an update of its own where there is anything to do.
// Adds to the report; returns the offers that were admitted, and the landmarks that were not.
struct Admitted {
  std::vector<Index> edges, refused_landmarks, returned_landmarks;  // vertices
};
Admitted admit(Isam2Replay& replay, Admission& admission, std::span<const Offer> offers,
               elim::Wide budget, Isam2Report& report);

}  // namespace sg::solve
