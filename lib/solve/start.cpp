#include "lib/solve/start.h"

#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <queue>
#include <tuple>

#include "lib/factor/gauge.h"
#include "lib/factor/initialize.h"
#include "lib/factor/motion.h"
#include "lib/solve/chordal.h"
#include "lib/solve/isam2_replay.h"
#include "lib/solve/places.h"
#include "lib/text/error.h"
#include "lib/text/nearest.h"

namespace sg::solve {
namespace {

constexpr std::array table{
    Start{"file", factor::file_values}, Start{"odometry", factor::initial_values},
    Start{"chordal", chordal_start},    Start{"tree", tree_start},
    Start{"isam2", isam2_start},
};

std::vector<bool> poses_of(const Graph& graph) {
  std::vector<bool> result(graph.vertices());
  for (Index v = 0; v < graph.vertices(); ++v) result[v] = graph.role(v) == graph::Role::pose;
  return result;
}

// A way: the sum of the variances, the vertex that it leads to, and the last edge; -1 where the vertex stays.
using Way = std::tuple<double, Index, Index>;

}  // namespace

std::span<const Start> starts() {
  return table;
}

std::string start_names() {
  return text::listed(text::names_of(table));
}

std::string_view own_start(const Graph& graph) {
  return graph.edges_only ? "odometry" : "file";
}

const Start& find_start(std::string_view name) {
  for (const Start& start : table) {
    if (start.name == name) return start;
  }
  throw text::usage_error(text::no_such("start", name, text::names_of(table)));
}

factor::Values chordal_start(const factor::Problem& problem) {
  factor::Values values = factor::initial_values(problem);
  relax_rotations(problem, values);
  std::vector<bool> placed = poses_of(*problem.graph);
  solve_places(problem, placed, values);
  factor::place_rest(problem, placed, values);
  return values;
}

factor::Values tree_start(const factor::Problem& problem) {
  const Graph& graph = *problem.graph;
  factor::Values values = factor::initial_values(problem);
  std::vector<double> variance_of(graph.edges());
  std::vector<bool> left_out(graph.edges());
  for (Index e = 0; e < graph.edges(); ++e) {
    const auto motion = factor::measured_motion(problem, e);
    left_out[e] = !motion || !(motion->turn_information > 0);
    if (!left_out[e]) variance_of[e] = 1 / motion->turn_information;
  }
  const graph::Lists<> edges_at = graph::transpose(graph.edge_vertices, graph.vertices());
  const std::vector<bool> stays = factor::anchors(problem, left_out);
  std::vector<bool> reached(graph.vertices(), false);
  std::priority_queue<Way, std::vector<Way>, std::greater<>> ways;
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (stays[v]) ways.push({0, v, -1});
  }
  for (Index e = 0; e < graph.edges(); ++e) {
    if (!left_out[e] && graph.edge(e).size() == 1) ways.push({variance_of[e], graph.edge(e)[0], e});
  }
  while (!ways.empty()) {
    const auto [variance, v, by] = ways.top();
    ways.pop();
    if (reached[v]) continue;
    reached[v] = true;
    if (by >= 0) factor::place_vertex(problem, v, std::array{by}, reached, values);
    for (Index e : edges_at[v]) {
      for (Index w : graph.edge(e)) {
        if (!left_out[e] && !reached[w]) ways.push({variance + variance_of[e], w, e});
      }
    }
  }
  std::vector<bool> placed = poses_of(graph);
  factor::place_rest(problem, placed, values);
  return values;
}

factor::Values isam2_start(const factor::Problem& problem) {
  Isam2Options options;
  options.relinearize_skip = 10;
  Isam2Replay replay = make_isam2_replay(problem, options, 1, false);
  for (Index k = 0; k < replay.steps.steps; ++k) replay_step(replay, k);
  return replay.isam.estimate;
}

}  // namespace sg::solve
