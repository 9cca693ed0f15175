#include "lib/solve/isam2_window.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/order/stopwatch.h"
#include "lib/solve/isam2_leave.h"
#include "lib/solve/isam2_spend.h"
#include "lib/solve/isam2_turns.h"
#include "lib/solve/landmark_point.h"

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

bool composes(const Isam2Window& window) {
  return window.options.spend == Spend::keyframes || window.options.spend == Spend::mixed;
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

// Whether edge e names nothing that has left but poses that were composed, and has been moved to those that stand for
// them.
bool moves(Isam2Window& window, Index e) {
  for (Index v : window.replay.problem->graph->edge(e)) {
    const Index pose = window.replay.poses.index[v];
    if (window.left[v] && (pose < 0 || !is_composed(window.keyframes, pose))) return false;
  }
  return move_edge(window.replay, window.keyframes, e);
}

// How old what the step's edges name is, before any is moved.
void note_ages(Isam2Window& window, Index k) {
  window.spending.ages.clear();
  if (!composes(window)) return;
  for (Index e : window.replay.edges[k]) {
    Index oldest = k;
    for (Index v : window.replay.problem->graph->edge(e)) {
      const Index pose = window.replay.poses.index[v];
      oldest = std::min(oldest, pose >= 0 ? pose : window.last_seen[v]);
    }
    if (oldest >= 0) window.spending.ages.emplace_back(e, k - oldest);
  }
}

struct Step {
  std::vector<Index> vertices, edges;
};

// What enters at step k. Without a vertex that has left it is the replay's.
Step entering_at(Isam2Window& window, Index k) {
  const Isam2Replay& replay = window.replay;
  const bool nothing_has_left = window.first == 0 && window.keyframes.composed == 0;
  Step step;
  std::vector<Index> late;  // that have waited until now
  for (Index v : replay.vertices[k]) {
    const bool pose = replay.poses.index[v] >= 0;
    if (pose || nothing_has_left || is_complete(window, v, k)) {
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
  note_ages(window, k);
  for (Index e : replay.edges[k]) {
    if (names_left(window, e) && !moves(window, e)) {
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
    for (Index v : window.replay.problem->graph->edge(e)) {
      window.last_seen[v] = std::max(window.last_seen[v], last < 0 ? k : last);
      const Index j = window.replay.problem->variables.vertex_variable[v];
      if (j >= 0 && window.admission.place[j] < 0) window.admission.place[j] = last < 0 ? k : last;
    }
  }
}

// Whether no closure nor observation could be given back.
bool nothing_is_held(const Isam2Window& window) {
  const Isam2& isam = window.replay.isam;
  return std::ranges::none_of(window.admission.held, [&](const Admission::Held& held) {
    return held.edge >= 0
               ? isam.tree.row_clique[held.edge] >= 0
               : isam.tree.variable_clique[held.landmark] >= 0 && !isam.pinned[held.landmark];
  });
}

CliqueTree plan(Isam2Window& window, const Entering& entering, Index k, Leaving& leaving) {
  const Index least = turns_by_age(window, k);
  if (window.options.budget == 0 ||
      (window.options.spend == Spend::measurements && !nothing_is_held(window)))
    return plan_with(window, entering, k, least, leaving);
  if (composes(window)) return plan_spending(window, entering, k, least, leaving);
  return plan_within(window, entering, k, least, leaving);
}

}  // namespace

Isam2Window make_isam2_window(const factor::Problem& problem, const Isam2Options& isam, int min_obs,
                              bool start_from_file, const WindowOptions& options) {
  Isam2Window window;
  window.options = options;
  if (composes(window)) window.keyframes.own = rewritable(problem);
  window.replay = make_isam2_replay(window.keyframes.own ? window.keyframes.own->problem : problem,
                                    isam, min_obs, start_from_file);
  // Where every row is priced, by the cliques.
  if (options.spend == Spend::measurements) leave_cliques_apart(window.replay.isam);
  window.renewal = {.factor = options.renew, .budget = options.budget};
  window.min_obs = min_obs;
  const Graph& graph = *problem.graph;
  window.left.assign(graph.vertices(), false);
  window.last_seen.assign(graph.vertices(), -1);
  window.edges_of = graph::transpose(graph.edge_vertices, graph.vertices());
  window.admission = make_admission(window.replay);
  const std::size_t poses = window.replay.poses.pose.size();
  window.keyframes.stands_for.assign(poses, 1);
  window.keyframes.spread.assign(poses, 0);
  window.spending.losses.assign(poses, 0);
  window.spending.stays.assign(poses, -1);
  for (Index e = 0; e < graph.edges(); ++e)
    window.spending.rays = window.spending.rays || sees_along_ray(problem, e);
  return window;
}

namespace {

// What the plan says is done, and what leaves does so.
void carry_out(Isam2Window& window, const Entering& entering, const CliqueTree& plan,
               const Leaving& leaving, Isam2Report& report) {
  Isam2& isam = window.replay.isam;
  redo_and_solve(isam, entering.variables, entering.rows, plan, report);
  for (Index r : leaving.images) {
    isam.forgotten[r] = false;
    let_row_go(isam, r);
  }
  if (report.undetermined.empty() && report.finite)
    take_leave(isam, leaving.variables, window.options.smooth, report);
}

Isam2Report update(Isam2Window& window, const Step& step, Index k) {
  Isam2& isam = window.replay.isam;
  const Entering entering = enter(window.replay, step.vertices, step.edges);
  ++window.there;
  measure(window, k);
  note(window, step.edges, k);
  Isam2Report report;
  report.relinearized = begin_update(isam, entering.rows);
  if (is_worn(isam, window.renewal)) {
    mark_all(isam);
    ++window.renewed;
  }
  Leaving leaving;
  const order::Stopwatch watch;
  const CliqueTree made = plan(window, entering, k, leaving);
  window.choosing += watch.seconds() - window.planning;
  carry_out(window, entering, made, leaving, report);
  check_solved(window.replay, k, report);
  if (composes(window)) learn(window);
  return report;
}

// All measurements that could be refused or given back have been, and the poses alone are above the budget: the oldest
// leave.
void let_poses_go(Isam2Window& window, Index k, Isam2Report& report) {
  Leaving leaving;
  report.relinearized += begin_update(window.replay.isam, {});
  const CliqueTree made = plan_within(window, {}, k, 0, leaving);
  carry_out(window, {}, made, leaving, report);
}

Isam2Report step_at(Isam2Window& window, Index k) {
  Step step = entering_at(window, k);
  if (window.options.spend != Spend::measurements) return update(window, step, k);
  const std::vector<Offer> offers =
      take_offers(window.replay, k, window.min_obs, step.vertices, step.edges);
  Isam2Report report = update(window, step, k);
  const Admitted admitted =
      admit(window.replay, window.admission, offers, window.options.budget, report);
  note(window, admitted.edges, k);
  for (Index v : admitted.refused_landmarks)
    window.incomplete.insert(std::ranges::upper_bound(window.incomplete, v), v);
  for (Index v : admitted.returned_landmarks) window.left[v] = true;
  if (window.replay.isam.tree.ec_bt > window.options.budget) let_poses_go(window, k, report);
  check_solved(window.replay, k, report);
  return report;
}

}  // namespace

Isam2Report window_step(Isam2Window& window, Index k) {
  const order::Stopwatch watch;
  const double before = window.admission.choosing;
  Isam2Report report = step_at(window, k);
  window.choosing += window.admission.choosing - before;
  window.working += watch.seconds();
  return report;
}

Index factors(const Isam2Window& window) {
  const factor::Problem& problem = *window.replay.problem;
  const bool gauge =
      problem.held >= 0 && window.replay.isam.tree.row_clique[problem.graph->edges()] >= 0;
  return window.replay.isam.rows - (gauge ? 1 : 0) + window.constant;
}

}  // namespace sg::solve
