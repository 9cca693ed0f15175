#include "lib/solve/isam2_spend.h"

#include <algorithm>
#include <limits>

#include "lib/solve/isam2_leave.h"

namespace sg::solve {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
// Edges to what is less old are no return: they are there anyhow.
constexpr Index least_age = 3;
// Of a pose's observations: so few edges that will name it do not count.
constexpr double few_returns = 0.1;
// And so few do not count, whatever the pose observes.
constexpr double no_return = 0.001;
// Steps until it is tried again to let go only what nothing returns to, where that was not enough: it takes a plan.
constexpr Index pause = 8;
// Where poses are composed, so much more than is needed: it takes the way to the root apart.
constexpr double slack = 0.02;

bool is_observation(const Isam2Replay& replay, Index r) {
  const Graph& graph = *replay.problem->graph;
  return r < graph.edges() && std::ranges::any_of(graph.edge(r), [&](Index v) {
           return graph.role(v) == graph::Role::landmark;
         });
}

// Whether the oldest pose is named by so few edges to come that its observations are worth more: they would be given back
// if it were composed, and are kept where it leaves by age.
bool observations_outweigh(const Isam2Window& window, Index k) {
  const Isam2Replay& replay = window.replay;
  const Index oldest = window.first;
  int observations = 0;
  for (Index r : rows_in(replay.isam, variable_of(replay, replay.poses.pose[oldest])))
    observations += is_observation(replay, r) ? 1 : 0;
  return window.keyframes.stands_for[oldest] * expected_edges(window.spending.returns, k - oldest) <
         few_returns * observations;
}

// How many of the oldest poses nothing is going to name.
Index forsaken(const Isam2Window& window, Index k) {
  const Returns& returns = window.spending.returns;
  const Tail tail = tail_of(returns);
  Index poses = 0;
  for (Index pose = window.first; pose < k; ++pose) {
    if (is_composed(window.keyframes, pose)) continue;
    const double edges =
        std::max(expected_edges(returns, k - pose), expected_edges(tail, k - pose));
    if (window.keyframes.stands_for[pose] * edges > no_return) break;
    ++poses;
  }
  return poses;
}

// How many turns are worth what is lost by them.
Index turns_worth(const Isam2Window& window, Index k) {
  if (window.options.spend != Spend::mixed || window.spending.rays) return 0;
  return observations_outweigh(window, k) ? std::numeric_limits<Index>::max() : forsaken(window, k);
}

// By how much the sum of the variances of the positions that the pose stands for would rise: they hang on the way from its
// host. Infinite where it cannot be composed.
double loss_of_composing(const Isam2Window& window, Index pose) {
  const Isam2Replay& replay = window.replay;
  if (is_composed(window.keyframes, pose) || !can_be_composed(replay, pose, window.min_obs))
    return infinite;
  return (host_of(replay, pose).variance + window.keyframes.spread[pose]) *
         window.keyframes.stands_for[pose];
}

// The pose whose composing loses least, -1 where none can be. Losses are those of the last look, and of what was never
// looked at it is none; what is chosen is looked at.
Index cheapest_to_compose(Isam2Window& window, Index k) {
  Spending& spending = window.spending;
  const Index end = k - 1;  // the newest two stay
  for (;;) {
    Index best = -1;
    double least = infinite;
    for (Index pose = window.first; pose < end; ++pose) {
      if (spending.losses[pose] < least && spending.stays[pose] < k) {
        least = spending.losses[pose];
        best = pose;
      }
    }
    if (best < 0) return -1;
    const double now = loss_of_composing(window, best);
    if (now == infinite) {
      spending.stays[best] = k;
      continue;
    }
    const bool still = now <= least;
    spending.losses[best] = now;
    if (still) return best;
  }
}

// Landmarks that a composed pose had seen: when they were last seen; those with too few observations go.
void settle_landmarks(Isam2Window& window, std::span<const Index> landmarks) {
  Isam2Replay& replay = window.replay;
  Isam2& isam = replay.isam;
  for (const Index v : landmarks) {
    const Index j = variable_of(replay, v);
    if (j < 0 || window.left[v] || isam.tree.variable_clique[j] < 0) continue;
    int count = 0, height = 0;
    Index last = -1;
    for (Index r : rows_of(isam, j)) {
      if (isam.tree.row_clique[r] < 0 && !enters(isam, r)) continue;
      ++count;
      height += factor::block_rows(*replay.problem, r);
      for (Index end : replay.problem->graph->edge(r))
        last = std::max(last, replay.poses.index[end]);
    }
    const bool few = count < window.min_obs || height < pattern_of(isam).dim[j];
    const bool comes =
        std::ranges::any_of(rows_of(isam, j), [&](Index r) { return enters(isam, r); });
    if (!few || comes || isam.pinned[j]) {
      if (last >= 0) window.last_seen[v] = last;
      continue;
    }
    for (Index r : rows_in(isam, j)) {
      take_row_out(isam, r);
      ++window.keyframes.returned;
    }
    take_variable_out(isam, j);
    replay.placed[v] = false;
    window.last_seen[v] = -1;
    window.incomplete.insert(std::ranges::upper_bound(window.incomplete, v), v);
  }
}

void compose(Isam2Window& window, Index pose) {
  const std::vector<Index> landmarks = compose_away(window.replay, window.keyframes, pose);
  window.left[window.replay.poses.pose[pose]] = true;
  window.spending.losses[pose] = infinite;
  --window.there;
  while (is_composed(window.keyframes, window.first)) ++window.first;
  settle_landmarks(window, landmarks);
}

}  // namespace

CliqueTree plan_spending(Isam2Window& window, const Entering& entering, Index k, Index least,
                         Leaving& leaving) {
  Isam2& isam = window.replay.isam;
  const auto budget = static_cast<double>(window.options.budget);
  const Index most = turns_worth(window, k);
  if (most > least && k >= window.spending.again) {
    CliqueTree plan = plan_within(window, entering, k, least, leaving, most);
    if (ec_after(isam, plan, leaving.variables) <= window.options.budget) return plan;
    window.spending.again = k + pause;
  }
  CliqueTree plan = plan_with(window, entering, k, least, leaving);
  // What poses are thought to free is what the tree as it is would lose; the edges that move fill it again. So ever more is
  // asked for, until there is room.
  for (double asked = 1;; asked *= 2) {
    const auto ec = static_cast<double>(ec_after(isam, plan, leaving.variables));
    if (ec <= budget) break;
    double excess = asked * (ec - budget) + slack * budget;
    Index at_once = std::max<Index>(4, window.there / 16);
    bool any = false;
    for (; excess > 0 && at_once > 0; --at_once) {
      const Index pose = cheapest_to_compose(window, k);
      if (pose < 0) break;
      const Index v = window.replay.poses.pose[pose];
      excess -=
          freed_by(isam, variable_of(window.replay, v), host_of(window.replay, pose).variable);
      compose(window, pose);
      any = true;
    }
    if (!any) break;
    plan = plan_with(window, entering, k, least, leaving);
  }
  if (ec_after(isam, plan, leaving.variables) <= window.options.budget) return plan;
  return plan_within(window, entering, k, leaving.turns(), leaving);
}

void learn(Isam2Window& window) {
  next_step(window.spending.returns);
  for (const auto& [e, old] : window.spending.ages) {
    if (old >= least_age) note_return(window.spending.returns, old);
  }
}

}  // namespace sg::solve
