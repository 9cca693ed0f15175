// Variables leave the smoother: marginalization on the Bayes tree.
//
// To marginalize variables M is to eliminate them first: they leave P(M | N), N their neighbours then, and pass a factor
// on N, which stays. On a Bayes tree this is local. Factors that reach M are held by the cliques in which M is frontal,
// unless another variable was eliminated before one of M, which shows by a clique that has it in the separator. Those
// cliques are taken out with the update at hand, and M is put at the beginning of the order of what is eliminated anew.
// Then, from the leaves up, in every clique P(M + R | S) that holds some of M:
//
//   1  The rows and priors of the clique that reach M make a front of their own, and M is eliminated: P(M | N), N within
//      R + S. It is thrown away, or kept for smoothing the past.
//   2  What that passes on becomes a prior: a clique without frontal variables below what remains. It is summed up as
//      any child's update is, and the tree's algorithms know no other.
//   3  The clique is eliminated again without M: P(R | S), if anything remains. What it passes up is what it passed
//      before, so that nothing above is touched.
//
// Consistency. A prior is linear in the steps Delta_N from Theta_N; were Theta_N to move, it would speak of other
// points. Variables that a prior reaches therefore keep their linearization points (they are pinned), for all of
// their factors: a factor never sees a variable elsewhere than the prior does, and directions that nothing measures
// stay unmeasured. Estimates go on moving, by the steps.
//
// Sources: Kaess et al., iSAM2 (2012), section 6; Chiu, Williams, Dellaert, Samarasekera, Kumar, Robust vision-aided
// navigation using sliding-window factor graphs (2013); Huang, Mourikis, Roumeliotis, Observability-based rules for
// designing consistent EKF SLAM estimators (2010), for first estimates; Dong-Si, Mourikis, Motion tracking with
// fixed-lag smoothing (2011).
#pragma once

#include <string_view>

#include "lib/solve/isam2_steps.h"

namespace sg::solve {

// An order that begins with `first` and ends with `last`: what is between is ordered by the options' ordering for what remains
// when `first` has been eliminated.
graph::Order order_after(const Isam2Options& options, const graph::Pattern& pattern,
                         std::span<const Index> first, std::span<const Index> last);

// From now on cliques are the Bayes tree's, none is relaxed (clique_tree.h): what leaves one is told by its own EC, and
// EC_BT stays a sum over cliques. Marks those that are relaxed. Where nothing has ever left, they are as they always were.
void leave_cliques_apart(Isam2& isam);

// Between begin_update and plan_top: `isam.leaving` says of these variables that they leave. Marks cliques that hold
// one below a variable that stays; at the first that leave, relaxed ones.
void mark_leaving(Isam2& isam, std::span<const Index> leaving);

// EC_BT when the plan has been carried out and `leaving` have left.
elim::Wide ec_after(const Isam2& isam, const CliqueTree& plan, std::span<const Index> leaving);

// After solve_down: the variables leave, with the rows that reach them. Their estimates stay. `keep`: their conditionals
// are kept, for smooth_past. Reports what it eliminated, and undetermined variables.
void take_leave(Isam2& isam, std::span<const Index> leaving, bool keep, Isam2Report& report);

// The estimates of all variables that have left, in the light of what was learnt since: their conditionals, back
// substituted.
void smooth_past(Isam2& isam);

}  // namespace sg::solve
