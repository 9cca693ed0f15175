// Poses that leave from the middle of a replay: keyframes stay, others are composed (as lib/prune/keyframes.h does it to a
// file).
//
// A pose p that has come to have nothing but edges to other poses and to landmarks leaves like this. Its nearest pose by
// them, its host h, stands for it from then on. Edges to landmarks are given back (their rows taken out); what other
// edges measure from p is measured from h, composed with the way from h to p, and so are the edges that name p later.
// The edges stay what they were, measurements of relative poses, with other ends and numbers: nothing is linear in
// them, and no point is pinned. Between two neighbours by odometry that is p's marginalization, to first order; where p
// has more edges, it takes their sums with the way as independent, as is usual. Of several edges to its host the best
// counts, and what has both ends in one pose says nothing.
//
// A landmark that is left with too few observations goes, and comes again when it has enough.
#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "lib/solve/isam2_replay.h"
#include "lib/solve/relative_pose.h"

namespace sg::solve {

struct Keyframes {
  std::unique_ptr<Rewritable> own;  // the replay's graph and problem; null: nothing is composed
  struct Way {
    Index host;
    RelativePose from_host;
  };
  std::unordered_map<Index, Way> ways;  // by pose index, of those that have been composed
  std::vector<Index> stands_for;        // by pose index: so many, itself included
  std::vector<double> spread;           // by pose index: the largest variance of a way to these
  Index composed = 0;                   // poses
  Index moved = 0;                      // edges
  Index returned = 0;                   // edges given back, and those that came to say nothing
};

// Whether pose k has been composed; where it has, who stands for it, which need not be there any more.
inline bool is_composed(const Keyframes& keyframes, Index k) {
  return keyframes.ways.contains(k);
}
Keyframes::Way way_to(Keyframes& keyframes, Index k);

// An edge that has not entered and names poses that were composed is moved to those that stand for them. False where it
// cannot be, or says nothing then.
bool move_edge(Isam2Replay& replay, Keyframes& keyframes, Index e);

// Whether pose k may leave so, with no landmark of the linear factors left with fewer than min_obs observations.
bool can_be_composed(const Isam2Replay& replay, Index k, int min_obs);

// The pose that would stand for pose k, which can be composed.
struct Host {
  Index variable;
  double variance;  // of the way from it
};
Host host_of(const Isam2Replay& replay, Index k);

// Between begin_update and plan_top. Returns the landmarks that pose k had seen.
std::vector<Index> compose_away(Isam2Replay& replay, Keyframes& keyframes, Index k);

// Between begin_update and plan_top: whether row r comes in with the update.
inline bool enters(const Isam2& isam, Index r) {
  return isam.tree.row_clique[r] < 0 && isam.gram_at[r] >= 0;
}

// By how much EC_BT falls without variable j, by the tree as it is; heir: a variable that takes its place in the cliques, and so
// frees no more than those that hold both. Takes the time of the part of the tree that has j.
double freed_by(const Isam2& isam, Index j, Index heir = -1);

// Estimates of the poses that were composed, by the ways from those that stand for them; between two neighbours on the path,
// as the variances of the ways to both have it.
void place_composed(Isam2Replay& replay, Keyframes& keyframes);

}  // namespace sg::solve
