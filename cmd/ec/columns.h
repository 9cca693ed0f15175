// The tables of sg-ec: a row a graph and ordering, a row a variable, a row an edge.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cmd/common/method.h"
#include "cmd/common/table.h"
#include "lib/elim/bayes_tree.h"
#include "lib/graph/replay.h"
#include "lib/solve/forecast.h"

namespace sg::ec {

// A graph, or the part of it that has entered by some step, under one order.
struct Subject {
  const cmd::MethodOptions& options;
  const std::string& file;
  std::optional<Index> step;
  Index vertices;
  Index edges;
  const Graph& graph;
  const graph::GraphPattern& variables;
  const cmd::Method* method = nullptr;
};
graph::Order order_of(const Subject& subject);

struct ScoreRow {
  const Subject& subject;
  std::optional<graph::Order> order_ = {};
  std::optional<elim::Symbolic> symbolic_ = {};
  std::optional<elim::Score> score_ = {};
  std::optional<elim::BayesTree> tree_ = {};
  std::optional<solve::Forecast> forecast_ = {};

  const graph::Pattern& pattern() const { return subject.variables.pattern; }
  const graph::Order& order();
  const elim::Symbolic& symbolic();
  const elim::Score& score();
  const elim::BayesTree& tree();
  const solve::Forecast& forecast();
};
extern const std::vector<cmd::Column<ScoreRow>> score_columns;

struct VertexRow {
  const Subject& subject;
  Index vertex;
  std::size_t position;
  std::int64_t frontal;
  std::int64_t separator;
  double ec;

  elim::Wide cost() const { return elim::elimination_cost(frontal, frontal + separator); }
};
extern const std::vector<cmd::Column<VertexRow>> vertex_columns;
// Calls show(row) of every variable, in elimination order.
void vertex_rows(const Subject& subject, const std::function<void(VertexRow)>& show);

struct EdgeRow {
  const Subject& subject;
  Index edge;
  graph::EdgeRole role;
  elim::Wide price;
  double ec;
};
extern const std::vector<cmd::Column<EdgeRow>> edge_columns;
// The same of every edge, in file order.
void edge_rows(const Subject& subject, const std::function<void(EdgeRow)>& show);

}  // namespace sg::ec
