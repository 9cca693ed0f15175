#include "cmd/ec/columns.h"

#include <numeric>

#include "cmd/common/calibration.h"
#include "lib/elim/row_price.h"

namespace sg::ec {

graph::Order order_of(const Subject& subject) {
  return cmd::order_by(*subject.method, subject.options, subject.graph, subject.variables);
}

const graph::Order& ScoreRow::order() {
  return cmd::once(order_, [&] { return order_of(subject); });
}

const elim::Symbolic& ScoreRow::symbolic() {
  return cmd::once(symbolic_, [&] { return elim::symbolic(pattern(), order()); });
}

const elim::Score& ScoreRow::score() {
  return cmd::once(score_, [&] { return elim::column_score(symbolic()); });
}

const elim::BayesTree& ScoreRow::tree() {
  return cmd::once(tree_, [&] { return elim::bayes_tree(symbolic()); });
}

const solve::Forecast& ScoreRow::forecast() {
  return cmd::once(forecast_, [&] { return solve::forecast(pattern(), order(), symbolic()); });
}

namespace {

// Of one elimination here; nothing where nobody calibrated.
std::optional<double> foretold_seconds(ScoreRow& row) {
  static const std::optional<solve::Times> times = cmd::read_calibration();
  if (!times) return {};
  return solve::seconds(row.forecast().work, *times);
}

template <class Row>
cmd::Column<Row> file_column() {
  return {"file", "The file", [](Row& row) { return row.subject.file; }, "several files"};
}

template <class Row>
cmd::Column<Row> order_column() {
  return {"order", "The ordering; file:NAME is the one that sg-order left",
          [](Row& row) { return row.subject.method->label; }};
}

std::string_view name(graph::EdgeRole role) {
  switch (role) {
    case graph::EdgeRole::odometry:
      return "odometry";
    case graph::EdgeRole::loop_closure:
      return "loop";
    case graph::EdgeRole::observation:
      return "observation";
    default:
      return "other";
  }
}

cmd::IdList ids(EdgeRow& row) {
  cmd::IdList result;
  for (const Index v : row.subject.graph.edge(row.edge)) result.push_back(row.subject.graph.id[v]);
  return result;
}

}  // namespace

const std::vector<cmd::Column<ScoreRow>> score_columns{
    file_column<ScoreRow>(),
    {"step", "Of the replay, from 0", [](ScoreRow& row) { return row.subject.step; }, "--trace"},
    order_column<ScoreRow>(),
    {"vertices", "Of the graph, fixed ones included",
     [](ScoreRow& row) { return row.subject.vertices; }},
    {"edges", "Of the graph", [](ScoreRow& row) { return row.subject.edges; }},
    {"dim", "Scalar dimension of all variables: of what is not fixed",
     [](ScoreRow& row) {
       return std::accumulate(row.pattern().dim.begin(), row.pattern().dim.end(), std::int64_t{0});
     }},
    {"ec", "Elimination complexity", [](ScoreRow& row) { return row.score().ec; }},
    {"rose", "Multiplications of a Cholesky factorization, by Rose's count",
     [](ScoreRow& row) { return row.score().rose; }},
    {"flops", "The same by CHOLMOD's count", [](ScoreRow& row) { return row.score().flops; }},
    {"nnz", "Entries of the factor", [](ScoreRow& row) { return row.score().nnz; }},
    {"fill", "Those of them that the system matrix did not have",
     [](ScoreRow& row) { return row.score().nnz - elim::system_nnz(row.pattern()); }},
    {"max_clique", "The largest d_f + d_s", [](ScoreRow& row) { return row.score().max_clique; }},
    {"height", "Variables on the longest path of the elimination tree",
     [](ScoreRow& row) { return row.score().height; }},
    {"cliques", "Cliques of the Bayes tree", [](ScoreRow& row) { return row.tree().cliques(); }},
    {"ec_bt", "Elimination complexity of the Bayes tree: the sum over cliques",
     [](ScoreRow& row) { return elim::elimination_complexity(row.tree()); }},
    {"factor_bytes", "Bytes of the factor as sg-solve keeps it: numbers and lists",
     [](ScoreRow& row) { return row.forecast().factor_bytes; }},
    {"peak_bytes", "The same with the updates that wait while it is made",
     [](ScoreRow& row) { return row.forecast().peak_bytes; }},
    {"seconds", "Foretold for one elimination on one thread (sg-solve --calibrate)",
     foretold_seconds},
};

const std::vector<cmd::Column<VertexRow>> vertex_columns{
    file_column<VertexRow>(),
    order_column<VertexRow>(),
    {"id", "Of the vertex", [](VertexRow& row) { return row.subject.graph.id[row.vertex]; }},
    {"tag", "Its type",
     [](VertexRow& row) { return row.subject.graph.type_of_vertex(row.vertex).tag; }},
    {"role", "pose, landmark or other",
     [](VertexRow& row) { return graph::name(row.subject.graph.role(row.vertex)); }},
    {"position", "In the order, from 0", &VertexRow::position},
    {"d_f", "Its scalar dimension", &VertexRow::frontal},
    {"d_s", "Scalar dimension of its separator", &VertexRow::separator},
    {"cost", "d_f (d_f + d_s)^2", [](VertexRow& row) { return row.cost(); }},
    {"share", "Of EC", [](VertexRow& row) { return elim::to_double(row.cost()) / row.ec; }},
};

const std::vector<cmd::Column<EdgeRow>> edge_columns{
    file_column<EdgeRow>(),
    order_column<EdgeRow>(),
    {"ids", "Of its vertices", ids},
    {"tag", "Its type", [](EdgeRow& row) { return row.subject.graph.type_of_edge(row.edge).tag; }},
    {"role", "odometry, loop, observation or other", [](EdgeRow& row) { return name(row.role); }},
    {"price", "What EC would lose without it", &EdgeRow::price},
    {"share", "Of EC",
     [](EdgeRow& row) { return row.ec > 0 ? elim::to_double(row.price) / row.ec : 0; }},
    {"free", "yes where its price is 0, else no", [](EdgeRow& row) { return row.price == 0; }},
};

void edge_rows(const Subject& subject, const std::function<void(EdgeRow)>& show) {
  const graph::Order order = order_of(subject);
  const graph::Pattern& pattern = subject.variables.pattern;
  const double ec = elim::to_double(elim::elimination_complexity(pattern, order));
  const std::vector<elim::Wide> prices = elim::row_prices(pattern, order);
  const auto roles = graph::edge_roles(subject.graph, graph::pose_index(subject.graph));
  for (Index e = 0; e < subject.edges; ++e) show({subject, e, roles[e], prices[e], ec});
}

void vertex_rows(const Subject& subject, const std::function<void(VertexRow)>& show) {
  const graph::Order order = order_of(subject);
  const elim::Symbolic symbolic = elim::symbolic(subject.variables.pattern, order);
  const double ec = elim::to_double(elim::elimination_complexity(symbolic));
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Index vertex = subject.variables.variable_vertex[order[k]];
    const std::int64_t frontal = symbolic.dim[k];
    show({subject, vertex, k, frontal, symbolic.count[k] - frontal, ec});
  }
}

}  // namespace sg::ec
