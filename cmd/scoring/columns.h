// The table of sg-score: what a graph is worth, and what it costs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cmd/common/method.h"
#include "cmd/common/table.h"
#include "lib/score/divergence.h"
#include "lib/score/fill.h"
#include "lib/score/sigma.h"
#include "lib/score/trajectory.h"
#include "lib/trees/tree_weights.h"

namespace sg::scoring {

// What graphs are compared with.
struct Reference {
  Graph graph;
  score::Trajectory trajectory = score::trajectory(graph);
};

// What a graph's rows share, whatever the ordering.
struct Subject {
  const cmd::MethodOptions& methods;
  score::Alignment alignment;
  const std::optional<Reference>& reference;
  const std::optional<score::Odometry>& odometry;  // to place dropped poses by
  const std::string& file;
  const Graph& graph;
  trees::Weights weights;
  graph::GraphPattern variables = graph::graph_pattern(graph);
  std::optional<score::Trajectory> trajectory_ = {};
  std::optional<double> log_trees_ = {};
  std::optional<std::optional<double>> lambda2_ = {};
  std::optional<score::TrajectoryError> error_ = {};
  std::optional<std::optional<score::Divergence>> divergence_ = {};
  std::optional<factor::Problem> problem_ = {};
  std::optional<factor::Values> values_ = {};
  std::optional<std::vector<score::PoseSigma>> sigmas_ = {};  // none of a singular graph
  bool singular = false;                                      // once it has been eliminated

  const score::Trajectory& trajectory();
  double log_trees();
  std::optional<double> lambda2();
  const factor::Problem& problem();
  const factor::Values& values();
  const score::TrajectoryError& error();
  const std::optional<score::Divergence>& divergence();
  std::optional<double> kld();
  std::optional<double> overconfidence();
};

struct Row {
  Subject& of;
  cmd::Method method;
  std::optional<graph::Order> order_ = {};
  std::optional<std::optional<solve::Elimination>> elimination_ = {};  // nothing if singular

  const graph::Order& order();
  elim::Wide ec();
  std::optional<solve::Elimination>& elimination();
  std::optional<double> log_det();
  const std::vector<score::PoseSigma>& sigmas();
  std::optional<double> sigma_mean();
  std::optional<double> sigma_max();
};
extern const std::vector<cmd::Column<Row>> columns;

}  // namespace sg::scoring
