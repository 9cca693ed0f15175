// A replay (isam2_replay.h) that lets the past go: fixed-lag smoothing, and a window that a budget of elimination
// complexity sets.
//
// The window holds the newest poses and the landmarks that they have seen. A step's edges may name all that was in the
// window before it; then the oldest poses leave (isam2_leave.h):
//
//   lag       as many as leave N poses;
//   distance  those that are farther back than D metres along the estimated path;
//   budget    as few as bring EC_BT, the worst case of an update, to the budget or below. What it will be is known
//             before anything is eliminated, from the symbolic elimination of what the update is to redo; while it is too
//             much, one more pose leaves, then two, then four, and then as few of them as do. So the window grows by a
//             pose a step where there is room, and shrinks where there is none (Frey, Steiner, How propose this).
//
// A landmark leaves with the last pose that saw it, or before, where the newest pose with all of its landmarks is above
// the budget.
//
// Images. A prior keeps a landmark's linearization point. Of one that is seen by an image of it (pixels, a disparity, a
// bearing) that is a guess as long as the rays are nearly parallel, and what sees it from elsewhere is pulled there: in windows
// of 5 to 20 poses the error grew to tens of metres, or pivots vanished. So no prior reaches such a landmark. It leaves with
// the first pose that does so when its track has ended, by all images that are there; before that those of what leaves are
// forgotten, as long as min_obs are left. (As Leutenegger et al. do, Keyframe-based visual-inertial odometry using nonlinear
// optimization, Int. J. Robotics Research 34, 2015.)
//
// Edges that name what has left are dropped and counted. A landmark enters when min_obs observations from poses that are
// there have come together: where the window is shorter than that takes, it waits. Constants never leave.
#pragma once

#include <limits>

#include "lib/solve/isam2_admission.h"
#include "lib/solve/isam2_keyframes.h"
#include "lib/solve/isam2_renew.h"
#include "lib/solve/isam2_replay.h"
#include "lib/solve/isam2_returns.h"

namespace sg::solve {

// What gives where a budget leaves no room.
enum class Spend : std::uint8_t {
  window,        // the oldest poses leave
  measurements,  // closures and observations are refused or given back (isam2_admission.h); then the oldest poses leave
  keyframes,  // poses are composed (isam2_keyframes.h) that lose least by it; where none can be, the oldest leave
  mixed,  // either, by what comes back to the oldest (isam2_spend.h)
};

struct WindowOptions {
  Index lag = 0;                                              // poses; 0: any number
  double distance = std::numeric_limits<double>::infinity();  // metres
  elim::Wide budget = 0;                                      // of EC_BT; 0: none
  Spend spend = Spend::window;
  bool smooth = false;  // keep the past for smooth_past
  double renew = 0;     // order the whole anew beyond this factor (isam2_renew.h); 0: never
};

// What is known of what a budget is best spent on (isam2_spend.h).
struct Spending {
  Returns returns;
  bool rays = false;  // landmarks are seen along rays
  // By pose index: what composing it loses, when last looked at, infinite once it is; the step in which it could not be, -1.
  std::vector<double> losses;
  std::vector<Index> stays;
  Index again = 0;  // the first step that tries again to let poses leave rather than compose them
  std::vector<std::pair<Index, Index>> ages;  // of this step's edges, what they name: edge and age
};

struct Isam2Window {
  Isam2Replay replay;
  WindowOptions options;
  int min_obs = 1;

  Index first = 0;     // pose index of the oldest that is there
  Index there = 0;     // poses
  Index constant = 0;  // edges that have entered and hold no variable
  Index dropped = 0;   // edges that named what had left
  std::vector<double>
      travelled;                 // by pose index, of those that have entered: metres along the path
  std::vector<bool> left;        // by vertex
  std::vector<Index> last_seen;  // by vertex, no pose: pose index, -1 before it enters
  graph::Lists<> edges_of;       // by vertex
  Admission admission;
  Keyframes keyframes;
  Spending spending;
  Index usual_turns = 0;  // beyond what is too old, of the last step
  double planning = 0;    // seconds of the last plan
  double choosing =
      0;  // seconds so far of pricing and choosing: of all but the plans that were carried out
  double working = 0;  // seconds so far of all steps
  Renewal renewal;
  Index renewed = 0;              // steps that ordered the whole anew
  std::vector<Index> incomplete;  // vertices that wait for observations, ascending
};

Isam2Window make_isam2_window(const factor::Problem& problem, const Isam2Options& isam, int min_obs,
                              bool start_from_file, const WindowOptions& options);
Isam2Window make_isam2_window(const factor::Problem&&, const Isam2Options&, int, bool,
                              const WindowOptions&) = delete;

// Step k, after 0 .. k - 1. Throws as replay_step does. The budget is kept unless replay.isam.tree.ec_bt is above it
// afterwards: then the newest pose and what it sees are too much for it, or, where measurements are what gives, all poses
// by their odometry.
Isam2Report window_step(Isam2Window& window, Index k);

// Edges that are there.
Index factors(const Isam2Window& window);

}  // namespace sg::solve
