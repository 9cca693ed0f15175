#include "lib/solve/isam2_replay.h"

#include <algorithm>

#include "lib/factor/initialize.h"
#include "lib/solve/snapshot.h"
#include "lib/solve/undetermined.h"
#include "lib/text/error.h"

namespace sg::solve {
namespace {

// Edges of the step that stand at v, those to the pose before it first: odometry goes before loop
// closures.
std::vector<Index> edges_at(const Isam2Replay& replay, Index v, std::span<const Index> edges) {
  const Graph& graph = *replay.problem->graph;
  const Index before =
      replay.poses.index[v] > 0 ? replay.poses.pose[replay.poses.index[v] - 1] : -1;
  std::vector<Index> found;
  for (Index e : edges) {
    if (std::ranges::find(graph.edge(e), v) != graph.edge(e).end()) found.push_back(e);
  }
  std::stable_partition(found.begin(), found.end(), [&](Index e) {
    return std::ranges::find(graph.edge(e), before) != graph.edge(e).end();
  });
  return found;
}

void start_vertex(Isam2Replay& replay, Index v, std::span<const Index> edges) {
  const factor::Problem& problem = *replay.problem;
  factor::Values& estimate = replay.isam.estimate;
  double* const x = estimate.data() + problem.value_at[v];
  const Index j = problem.variables.vertex_variable[v];
  const bool constant = j < 0 || j == problem.held;
  const bool keep = replay.start_from_file || (constant && !replay.file.empty());
  if (keep ||
      !factor::place_vertex(problem, v, edges_at(replay, v, edges), replay.placed, estimate)) {
    if (replay.file.empty()) {
      factor::set_origin(problem.space[v], x);
    } else {
      std::copy(replay.file.begin() + problem.value_at[v],
                replay.file.begin() + problem.value_at[v + 1], x);
    }
  }
  std::copy(estimate.begin() + problem.value_at[v], estimate.begin() + problem.value_at[v + 1],
            replay.isam.linearized.begin() + problem.value_at[v]);
  replay.placed[v] = true;
}

text::Error diverged(Index step) {
  return text::computation_error(
      "step " + std::to_string(step) +
      ": the iterations diverge: the estimate has left the range in which its measurements "
      "determine it; start elsewhere (--init), or solve it in batch (sg-solve)");
}

// Whether the rows that are there determine all, where vertices start: then iterations went astray.
bool determined_at_start(const Isam2Replay& replay, Snapshot& snapshot) {
  const factor::Problem& problem = *replay.problem;
  try {
    linearize_at(problem, replay.start_from_file ? replay.file : factor::initial_values(problem),
                 snapshot);
  } catch (const text::Error&) {  // there is no derivative there
    return false;
  }
  return null_space(snapshot.system).dimension == 0;
}

text::Error singular(Index step, const NullSpace& open, std::span<const Id> id) {
  return text::computation_error("step " + std::to_string(step) + ": " +
                                 singular_error(open, id).what());
}

// Of a window (isam2_window.h): what has left would be needed.
text::Error determined_no_more(const factor::Problem& problem, Index step,
                               std::span<const Index> variables) {
  std::vector<Id> ids;
  for (const Index j : variables)
    ids.push_back(problem.graph->id[problem.variables.variable_vertex[j]]);
  std::ranges::sort(ids);
  return text::computation_error(
      "step " + std::to_string(step) +
      ": the system is singular: what the window still holds leaves " + id_ranges(ids) +
      " undetermined; a longer lag or a larger budget keeps more of what determines " +
      (ids.size() == 1 ? "it" : "them"));
}

// Elimination names the last variables of what is free to move; the null space knows them all, where all rows are
// there still.
[[noreturn]] void throw_singular(const Isam2Replay& replay, Index step, const Isam2Report& report) {
  const factor::Problem& problem = *replay.problem;
  if (std::ranges::any_of(replay.isam.pinned, std::identity())) {
    throw determined_no_more(problem, step, report.undetermined);
  }
  Snapshot snapshot;
  take_snapshot(replay.isam, true, snapshot);
  std::vector<Id> id;
  for (Index j : snapshot.variable) {
    id.push_back(problem.graph->id[problem.variables.variable_vertex[j]]);
  }
  const NullSpace open = null_space(snapshot.system);
  if (open.dimension > 0 && determined_at_start(replay, snapshot)) throw diverged(step);
  throw singular(step, open, id);
}

}  // namespace

Isam2Replay make_isam2_replay(const factor::Problem& problem, const Isam2Options& options,
                              int min_obs, bool start_from_file) {
  const Graph& graph = *problem.graph;
  if (start_from_file && graph.edges_only)
    throw text::input_error(graph.file, 0, "the file has no VERTEX line to start from");
  Isam2Replay result;
  result.problem = &problem;
  result.start_from_file = start_from_file;
  if (!graph.edges_only) result.file = factor::file_values(problem);
  result.poses = graph::pose_index(graph);
  result.steps = graph::replay(graph, result.poses, min_obs);
  result.vertices = graph::grouped(result.steps.vertex_step, result.steps.steps);
  result.edges = graph::grouped(result.steps.edge_step, result.steps.steps);
  result.placed.assign(graph.vertices(), false);
  result.isam = make_isam2(problem, options);
  return result;
}

Entering enter(Isam2Replay& replay, std::span<const Index> vertices, std::span<const Index> edges) {
  const factor::Problem& problem = *replay.problem;
  const Graph& graph = *problem.graph;
  Entering entering;
  auto& [variables, rows] = entering;
  for (const graph::Role role : {graph::Role::pose, graph::Role::landmark, graph::Role::other}) {
    for (Index v : vertices) {
      if (graph.role(v) != role) continue;
      start_vertex(replay, v, edges);
      const Index j = problem.variables.vertex_variable[v];
      if (j < 0) continue;
      variables.push_back(j);
      if (j == problem.held) rows.push_back(graph.edges());
    }
  }
  for (Index e : edges) {
    if (!problem.variables.pattern.rows[e].empty()) rows.push_back(e);
  }
  return entering;
}

void check_solved(const Isam2Replay& replay, Index k, const Isam2Report& report) {
  if (!report.undetermined.empty()) throw_singular(replay, k, report);
  if (!report.finite) throw diverged(k);
}

Isam2Report replay_step(Isam2Replay& replay, Index k) {
  const Entering entering = enter(replay, replay.vertices[k], replay.edges[k]);
  Isam2Report report = update(replay.isam, entering.variables, entering.rows);
  check_solved(replay, k, report);
  return report;
}

}  // namespace sg::solve
