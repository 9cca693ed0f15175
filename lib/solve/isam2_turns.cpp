#include "lib/solve/isam2_turns.h"

#include <algorithm>
#include <cmath>

#include "lib/order/stopwatch.h"
#include "lib/solve/isam2_leave.h"

namespace sg::solve {
namespace {

// Whether vertex v, which is no pose, is in the window.
bool is_present(const Isam2Window& window, Index v) {
  return window.replay.poses.index[v] < 0 && window.last_seen[v] >= 0 && !window.left[v];
}

// Rows of landmark v that are there or come with this step, and name none of the poses that leave with the next turn.
Index rows_left(const Isam2Window& window, Index v) {
  const Isam2& isam = window.replay.isam;
  const auto stays = [&](Index r) {
    return (isam.tree.row_clique[r] >= 0 || enters(isam, r)) &&
           std::ranges::none_of(window.replay.problem->graph->edge(r), [&](Index u) {
             const Index pose = window.replay.poses.index[u];
             return 0 <= pose && pose <= window.first;
           });
  };
  return std::ranges::count_if(rows_of(isam, variable_of(window.replay, v)), stays);
}

// Whether edge e sees of landmark v not where it stands but an image of that: pixels, a disparity, a bearing.
bool sees_image(const factor::Problem& problem, Index e, Index v) {
  return graph::row(problem.model[e]->type).measure.space != problem.space[v];
}

// Whether landmark v stays when the oldest pose, which saw it by edge e, has left.
bool outlasts(const Isam2Window& window, Index v, Index e, Index k) {
  if (!sees_image(*window.replay.problem, e, v)) return window.last_seen[v] > window.first;
  return window.last_seen[v] >= k - 1 && rows_left(window, v) >= window.min_obs;
}

// What the next turn would let go.
struct Next {
  std::vector<Index> variables, images;
};

Next next_to_leave(const Isam2Window& window, Index k) {
  const factor::Problem& problem = *window.replay.problem;
  const Index pose = window.replay.poses.pose[window.first];
  const bool newest = window.first == k;
  Next next;
  const auto leaves = [&](Index v) {
    const Index j = problem.variables.vertex_variable[v];
    if (j >= 0 && !window.left[v] && std::ranges::find(next.variables, j) == next.variables.end())
      next.variables.push_back(j);
  };
  for (Index e : window.edges_of[pose]) {
    for (Index v : problem.graph->edge(e)) {
      if (!is_present(window, v)) continue;
      if (newest) {
        if (next.variables.empty()) leaves(v);  // one of them
      } else if (!outlasts(window, v, e, k)) {
        leaves(v);
      } else if (sees_image(problem, e, v) && window.replay.isam.tree.row_clique[e] >= 0) {
        next.images.push_back(e);
      }
    }
  }
  if (!newest) leaves(pose);
  return next;
}

// What these free of EC_BT, by the tree as it is.
double freed_by_all(const Isam2& isam, std::span<const Index> variables) {
  double sum = 0;
  for (const Index j : variables) sum += freed_by(isam, j);
  return sum;
}

void add_turn(Isam2Window& window, Index k, Leaving& leaving) {
  Isam2& isam = window.replay.isam;
  const bool pose = window.first < k;
  const Next next = next_to_leave(window, k);
  leaving.turn.push_back({leaving.variables.size(), leaving.images.size(), window.first, pose,
                          freed_by_all(isam, next.variables)});
  for (const Index j : next.variables) {
    window.left[window.replay.problem->variables.variable_vertex[j]] = true;
    isam.leaving[j] = true;
    leaving.variables.push_back(j);
  }
  for (const Index r : next.images) {
    mark_to_root(isam, isam.tree.row_clique[r]);
    isam.forgotten[r] = true;
    leaving.images.push_back(r);
  }
  if (!pose) return;
  --window.there;
  do {
    ++window.first;
  } while (is_composed(window.keyframes, window.first));
}

void last_stays(Isam2Window& window, Leaving& leaving) {
  const Leaving::Turn turn = leaving.turn.back();
  leaving.turn.pop_back();
  for (std::size_t i = turn.variables; i < leaving.variables.size(); ++i) {
    const Index j = leaving.variables[i];
    window.left[window.replay.problem->variables.variable_vertex[j]] = false;
    window.replay.isam.leaving[j] = false;
  }
  leaving.variables.resize(turn.variables);
  for (std::size_t i = turn.images; i < leaving.images.size(); ++i)
    window.replay.isam.forgotten[leaving.images[i]] = false;
  leaving.images.resize(turn.images);
  window.first = turn.first;
  while (is_composed(window.keyframes, window.first)) ++window.first;
  window.there += turn.pose ? 1 : 0;
}

// So many of the turns as would be left if the last ones were taken back for that room.
Index fewer_turns(const Leaving& leaving, double room) {
  Index turns = leaving.turns();
  while (turns > 0 && leaving.turn[turns - 1].freed <= room) room -= leaving.turn[--turns].freed;
  return turns;
}

// How many more would free so much; at least one. Those beyond the first are taken to free as much as that.
Index more_turns(const Isam2Window& window, Index k, const Leaving& leaving, double excess) {
  const double next = window.first < k || leaving.turn.empty()
                          ? freed_by_all(window.replay.isam, next_to_leave(window, k).variables)
                          : leaving.turn.back().freed;
  return next > 0 ? static_cast<Index>(std::min(1e6, std::ceil(excess / next))) : 1;
}

// How many turns there are at most.
Index most_turns(const Isam2Window& window, Index k, const Leaving& leaving) {
  Index turns = leaving.turns() + window.there - 1;
  for (Index e : window.edges_of[window.replay.poses.pose[k]]) {
    for (Index v : window.replay.problem->graph->edge(e)) turns += is_present(window, v) ? 1 : 0;
  }
  return turns;
}

bool name_poses_alone(const Isam2& isam, std::span<const Index> rows) {
  const factor::Problem& problem = *isam.problem;
  return std::ranges::all_of(rows, [&](Index r) {
    return std::ranges::all_of(pattern_of(isam).rows[r], [&](Index j) {
      return problem.graph->role(problem.variables.variable_vertex[j]) == graph::Role::pose;
    });
  });
}

// With landmarks at hand; where EC_BT would be above the budget (0: none), without, if that costs less.
CliqueTree plan_in_budget(Isam2& isam, const Entering& entering, std::span<const Index> leaving,
                          elim::Wide budget) {
  CliqueTree plan = plan_top(isam, entering.variables, entering.rows);
  if (budget == 0) return plan;
  const elim::Wide ec = ec_after(isam, plan, leaving);
  if (ec <= budget || name_poses_alone(isam, entering.rows)) return plan;
  CliqueTree other = plan_top(isam, entering.variables, entering.rows, Last::poses);
  return ec_after(isam, other, leaving) < ec ? other : plan;
}

bool is_too_old(const Isam2Window& window, Index pose, Index k) {
  const WindowOptions& options = window.options;
  return (options.lag > 0 && pose <= k - options.lag) ||
         window.travelled[k] - window.travelled[pose] > options.distance;
}

}  // namespace

Index turns_by_age(const Isam2Window& window, Index k) {
  Index turns = 0;
  for (Index pose = window.first; pose < k && is_too_old(window, pose, k); ++pose)
    turns += is_composed(window.keyframes, pose) ? 0 : 1;
  return turns;
}

CliqueTree plan_with(Isam2Window& window, const Entering& entering, Index k, Index turns,
                     Leaving& leaving) {
  while (leaving.turns() < turns) add_turn(window, k, leaving);
  while (leaving.turns() > turns) last_stays(window, leaving);
  mark_leaving(window.replay.isam, leaving.variables);
  const order::Stopwatch watch;
  // What is admitted pays for what comes by the order that has landmarks at hand.
  const elim::Wide budget = window.options.spend == Spend::measurements ? 0 : window.options.budget;
  CliqueTree plan = plan_in_budget(window.replay.isam, entering, leaving.variables, budget);
  window.planning = watch.seconds();
  return plan;
}

CliqueTree plan_within(Isam2Window& window, const Entering& entering, Index k, Index least,
                       Leaving& leaving, Index most) {
  if (window.options.budget == 0) return plan_with(window, entering, k, least, leaving);
  const auto budget = static_cast<double>(window.options.budget);
  most = std::max(least, std::min(most, most_turns(window, k, leaving)));
  Index too_few = least - 1, enough = -1, turns = std::min(least + window.usual_turns, most);
  for (int tries = 1;; ++tries) {
    CliqueTree plan = plan_with(window, entering, k, turns, leaving);
    const double room =
        budget - static_cast<double>(ec_after(window.replay.isam, plan, leaving.variables));
    if (room >= 0) {
      enough = turns;
    } else {
      too_few = turns;
      if (enough <= turns) enough = -1;  // what has been marked since makes it cost more
    }
    const bool done = room >= 0 && (enough - too_few <= 1 + (enough - least) / 8 ||
                                    fewer_turns(leaving, room) == turns);
    if (done || (room < 0 && turns == most)) {
      window.usual_turns = turns - least;
      return plan;
    }
    // What turns are thought to free, and when that misleads, halves.
    const bool halve = tries > 3 && enough >= 0;
    if (halve) {
      turns =
          enough - too_few > 1 + (enough - least) / 8 ? too_few + (enough - too_few) / 2 : enough;
    } else if (room >= 0) {
      turns = std::max(too_few + 1, fewer_turns(leaving, room));
    } else {
      const Index more =
          std::min(Index{1} << std::min(tries, 20), more_turns(window, k, leaving, -room));
      turns = std::min(enough >= 0 ? enough : most, turns + more);
    }
  }
}

}  // namespace sg::solve
