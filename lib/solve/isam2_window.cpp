#include "lib/solve/isam2_window.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/solve/isam2_leave.h"

namespace sg::solve {
namespace {

// The position of a pose at the estimate; in the plane, z is 0.
std::array<double, 3> position(const Isam2Replay& replay, Index v) {
  const factor::Problem& problem = *replay.problem;
  std::array<double, 16> numbers{};
  factor::to_file(problem.space[v], replay.isam.estimate.data() + problem.value_at[v],
                  numbers.data());
  std::array<double, 3> result{};
  std::copy_n(numbers.begin(), graph::facts(problem.space[v]).position, result.begin());
  return result;
}

// How far pose k is along the path.
void measure(Isam2Window& window, Index k) {
  const Isam2Replay& replay = window.replay;
  if (k == 0) {
    window.travelled.assign(1, 0);
    return;
  }
  const auto a = position(replay, replay.poses.pose[k - 1]),
             b = position(replay, replay.poses.pose[k]);
  window.travelled.push_back(window.travelled.back() +
                             std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]));
}

bool names_left(const Isam2Window& window, Index e) {
  return std::ranges::any_of(window.replay.problem->graph->edge(e),
                             [&](Index v) { return bool(window.left[v]); });
}

bool is_waiting(const Isam2Window& window, Index v) {
  return std::ranges::binary_search(window.incomplete, v);
}

// Edges of vertex v that have come by step k and name nothing that has left.
std::vector<Index> observations(const Isam2Window& window, Index v, Index k) {
  std::vector<Index> found;
  std::ranges::copy_if(window.edges_of[v], std::back_inserter(found), [&](Index e) {
    const Index step = window.replay.steps.edge_step[e];
    return 0 <= step && step <= k && !names_left(window, e);
  });
  return found;
}

// Whether vertex v, which is no pose, has what it needs to enter.
bool is_complete(const Isam2Window& window, Index v, Index k) {
  const bool landmark = window.replay.problem->graph->role(v) == graph::Role::landmark;
  const auto needed = static_cast<std::size_t>(landmark ? window.min_obs : 1);
  return observations(window, v, k).size() >= needed;
}

struct Step {
  std::vector<Index> vertices, edges;
};

// What enters at step k. Without a vertex that has left it is the replay's.
Step entering_at(Isam2Window& window, Index k) {
  const Isam2Replay& replay = window.replay;
  Step step;
  std::vector<Index> late;  // that have waited until now
  for (Index v : replay.vertices[k]) {
    const bool pose = replay.poses.index[v] >= 0;
    if (pose || window.first == 0 || is_complete(window, v, k)) {
      step.vertices.push_back(v);
    } else {
      window.incomplete.insert(std::ranges::upper_bound(window.incomplete, v), v);
    }
  }
  for (Index e : replay.edges[k]) {
    for (Index v : replay.problem->graph->edge(e)) {
      if (is_waiting(window, v) && is_complete(window, v, k)) {
        std::erase(window.incomplete, v);
        late.push_back(v);
      }
    }
  }
  const auto enters = [&](Index e) {
    return std::ranges::none_of(replay.problem->graph->edge(e),
                                [&](Index v) { return is_waiting(window, v); });
  };
  for (Index e : replay.edges[k]) {
    if (names_left(window, e)) {
      ++window.dropped;
    } else if (enters(e)) {
      step.edges.push_back(e);
    }
  }
  for (Index v : late) {
    step.vertices.push_back(v);
    for (Index e : observations(window, v, k)) {
      if (replay.steps.edge_step[e] < k && enters(e)) step.edges.push_back(e);
    }
  }
  return step;
}

// Edges have entered.
void note(Isam2Window& window, std::span<const Index> edges, Index k) {
  const graph::PoseIndex& poses = window.replay.poses;
  for (Index e : edges) {
    window.constant += pattern_of(window.replay.isam).rows[e].empty() ? 1 : 0;
    Index last = -1;
    for (Index v : window.replay.problem->graph->edge(e)) last = std::max(last, poses.index[v]);
    for (Index v : window.replay.problem->graph->edge(e))
      window.last_seen[v] = std::max(window.last_seen[v], last < 0 ? k : last);
  }
}

// What leaves with this step, as far as it is decided: turn by turn the oldest pose with what no later one has seen, and
// where the newest alone is left, its landmarks.
struct Leaving {
  std::vector<Index> variables;
  std::vector<std::size_t> end{0};  // of every number of turns, in `variables`
  Index poses = 0;                  // of these turns

  Index turns() const { return static_cast<Index>(end.size()) - 1; }
};

bool is_present(const Isam2Window& window, Index v) {
  return window.replay.poses.index[v] < 0 && window.last_seen[v] >= 0 && !window.left[v];
}

void leave(Isam2Window& window, Index v, Leaving& leaving) {
  const Index j = window.replay.problem->variables.vertex_variable[v];
  if (j < 0 || window.left[v]) return;
  window.left[v] = true;
  window.replay.isam.leaving[j] = true;
  leaving.variables.push_back(j);
}

void next_leaves(Isam2Window& window, Index k, Leaving& leaving) {
  const Index pose = window.replay.poses.pose[window.first];
  const bool newest = window.first == k;
  for (Index e : window.edges_of[pose]) {
    for (Index v : window.replay.problem->graph->edge(e)) {
      if (!is_present(window, v) || window.last_seen[v] > window.first) continue;
      if (newest && leaving.variables.size() > leaving.end.back()) continue;  // one of them
      leave(window, v, leaving);
    }
  }
  if (!newest) {
    leave(window, pose, leaving);
    ++leaving.poses;
    ++window.first;
  }
  leaving.end.push_back(leaving.variables.size());
}

void last_stays(Isam2Window& window, Leaving& leaving) {
  leaving.end.pop_back();
  for (std::size_t i = leaving.end.back(); i < leaving.variables.size(); ++i) {
    const Index j = leaving.variables[i];
    window.left[window.replay.problem->variables.variable_vertex[j]] = false;
    window.replay.isam.leaving[j] = false;
  }
  leaving.variables.resize(leaving.end.back());
  if (leaving.turns() < leaving.poses) {
    --leaving.poses;
    --window.first;
  }
}

// How many turns there are at most.
Index most_turns(const Isam2Window& window, Index k) {
  Index turns = k - window.first;
  for (Index e : window.edges_of[window.replay.poses.pose[k]]) {
    for (Index v : window.replay.problem->graph->edge(e)) turns += is_present(window, v) ? 1 : 0;
  }
  return turns;
}

bool is_too_old(const Isam2Window& window, Index pose, Index k) {
  const WindowOptions& options = window.options;
  return (options.lag > 0 && pose <= k - options.lag) ||
         window.travelled[k] - window.travelled[pose] > options.distance;
}

// The plan of step k after so many turns.
CliqueTree plan_with(Isam2Window& window, const Entering& entering, Index k, Index turns,
                     Leaving& leaving) {
  while (leaving.turns() < turns) next_leaves(window, k, leaving);
  while (leaving.turns() > turns) last_stays(window, leaving);
  mark_leaving(window.replay.isam, leaving.variables);
  return plan_top(window.replay.isam, entering.variables, entering.rows);
}

// As few turns as bring the plan below the budget, `least` at least.
CliqueTree plan_within(Isam2Window& window, const Entering& entering, Index k, Index least,
                       Leaving& leaving) {
  const Index most = most_turns(window, k);
  CliqueTree plan = plan_with(window, entering, k, least, leaving);
  const elim::Wide budget = window.options.budget;
  if (budget == 0 || window.options.spend != Spend::window) return plan;
  const auto fits = [&](Index turns) {
    if (turns != leaving.turns()) plan = plan_with(window, entering, k, turns, leaving);
    return ec_after(window.replay.isam, plan, leaving.variables) <= budget;
  };
  if (fits(least)) return plan;
  Index too_few = least, enough = most;
  for (Index more = 1; least + more < most; more *= 2) {
    if (fits(least + more)) {
      enough = least + more;
      break;
    }
    too_few = least + more;
  }
  while (enough - too_few > 1 + (enough - least) / 8) {
    const Index between = too_few + (enough - too_few) / 2;
    (fits(between) ? enough : too_few) = between;
  }
  fits(enough);
  return plan;
}

}  // namespace

Isam2Window make_isam2_window(const factor::Problem& problem, const Isam2Options& isam, int min_obs,
                              bool start_from_file, const WindowOptions& options) {
  Isam2Window window;
  window.replay = make_isam2_replay(problem, isam, min_obs, start_from_file);
  window.options = options;
  window.renewal = {.factor = options.renew, .budget = options.budget};
  window.min_obs = min_obs;
  const Graph& graph = *problem.graph;
  window.left.assign(graph.vertices(), false);
  window.last_seen.assign(graph.vertices(), -1);
  window.edges_of = graph::transpose(graph.edge_vertices, graph.vertices());
  window.admission = make_admission(window.replay);
  return window;
}

namespace {

Isam2Report update(Isam2Window& window, const Step& step, Index k) {
  Isam2& isam = window.replay.isam;
  const Entering entering = enter(window.replay, step.vertices, step.edges);
  measure(window, k);
  note(window, step.edges, k);
  Isam2Report report;
  report.relinearized = begin_update(isam, entering.rows);
  if (is_worn(isam, window.renewal)) {
    mark_all(isam);
    ++window.renewed;
  }
  Index least = 0;
  while (window.first + least < k && is_too_old(window, window.first + least, k)) ++least;
  Leaving leaving;
  const CliqueTree plan = plan_within(window, entering, k, least, leaving);
  redo_and_solve(isam, entering.variables, entering.rows, plan, report);
  if (report.undetermined.empty() && report.finite)
    take_leave(isam, leaving.variables, window.options.smooth, report);
  check_solved(window.replay, k, report);
  return report;
}

}  // namespace

Isam2Report window_step(Isam2Window& window, Index k) {
  Step step = entering_at(window, k);
  if (window.options.spend == Spend::window) return update(window, step, k);
  const std::vector<Offer> offers =
      take_offers(window.replay, k, window.min_obs, step.vertices, step.edges);
  Isam2Report report = update(window, step, k);
  const Admitted admitted =
      admit(window.replay, window.admission, offers, window.options.budget, report);
  note(window, admitted.edges, k);
  for (Index v : admitted.refused_landmarks)
    window.incomplete.insert(std::ranges::upper_bound(window.incomplete, v), v);
  for (Index v : admitted.returned_landmarks) window.left[v] = true;
  check_solved(window.replay, k, report);
  return report;
}

Index factors(const Isam2Window& window) {
  const factor::Problem& problem = *window.replay.problem;
  const bool gauge =
      problem.held >= 0 && window.replay.isam.tree.row_clique[problem.graph->edges()] >= 0;
  return window.replay.isam.rows - (gauge ? 1 : 0) + window.constant;
}

}  // namespace sg::solve
