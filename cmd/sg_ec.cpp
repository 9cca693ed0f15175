// sg-ec: what a graph costs to eliminate; over time with --trace, by variable with --per-vertex, by edge with --per-edge.
#include <numeric>

#include "cmd/common/command.h"
#include "cmd/common/method.h"
#include "cmd/common/options.h"
#include "cmd/common/table.h"
#include "lib/elim/bayes_tree.h"
#include "lib/elim/row_price.h"
#include "lib/graph/lists.h"
#include "lib/graph/replay.h"
#include "lib/solve/eliminate.h"

using namespace sg;

namespace {

struct Options {
  cmd::Inputs inputs;
  cmd::OutputOptions output;
  cmd::TableOptions table;
  cmd::MethodOptions methods;
  bool trace = false;
  Index every = 1;
  Index min_obs = 1;
  bool per_vertex = false;
  bool per_edge = false;
};

// A graph, or the part of it that has entered by some step, under one order.
struct Subject {
  const Options& options;
  const std::string& file;
  std::optional<Index> step;
  Index vertices;
  Index edges;
  const Graph& graph;
  const graph::GraphPattern& variables;
  const cmd::Method* method = nullptr;
};

graph::Order order_of(const Subject& subject) {
  return cmd::order_by(*subject.method, subject.options.methods, subject.graph, subject.variables);
}

struct ScoreRow {
  const Subject& subject;
  std::optional<elim::Symbolic> symbolic_ = {};
  std::optional<elim::Score> score_ = {};
  std::optional<elim::BayesTree> tree_ = {};
  std::optional<graph::Order> order_ = {};
  std::optional<solve::Storage> storage_ = {};

  const graph::Pattern& pattern() const { return subject.variables.pattern; }
  const graph::Order& order() {
    return cmd::once(order_, [&] { return order_of(subject); });
  }
  const elim::Symbolic& symbolic() {
    return cmd::once(symbolic_, [&] { return elim::symbolic(pattern(), order()); });
  }
  const elim::Score& score() {
    return cmd::once(score_, [&] { return elim::column_score(symbolic()); });
  }
  const elim::BayesTree& tree() {
    return cmd::once(tree_, [&] { return elim::bayes_tree(symbolic()); });
  }
  const solve::Storage& storage() {
    return cmd::once(storage_, [&] { return solve::storage(pattern(), order()); });
  }
};

struct VertexRow {
  const Subject& subject;
  Index vertex;
  std::size_t position;
  std::int64_t frontal;
  std::int64_t separator;
  double ec;

  elim::Wide cost() const { return elim::elimination_cost(frontal, frontal + separator); }
};

struct EdgeRow {
  const Subject& subject;
  Index edge;
  graph::EdgeRole role;
  elim::Wide price;
  double ec;
};

template <class Row>
cmd::Column<Row> file_column() {
  return {"file", "The file", [](Row& row) { return row.subject.file; }, "several files"};
}

template <class Row>
cmd::Column<Row> order_column() {
  return {"order", "The ordering; file:NAME is the one that sg-order left",
          [](Row& row) { return row.subject.method->label; }};
}

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
    {"factor_bytes", "Of sg-solve's factor: numbers and lists",
     [](ScoreRow& row) { return row.storage().factor_bytes; }, "-f"},
    {"peak_bytes", "The same with the updates, where these are most",
     [](ScoreRow& row) { return row.storage().peak_bytes; }, "-f"},
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

void edge_rows(cmd::Table<EdgeRow>& table, const Subject& subject) {
  const graph::Order order = order_of(subject);
  const graph::Pattern& pattern = subject.variables.pattern;
  const double ec = elim::to_double(elim::elimination_complexity(pattern, order));
  const std::vector<elim::Wide> prices = elim::row_prices(pattern, order);
  const auto roles = graph::edge_roles(subject.graph, graph::pose_index(subject.graph));
  for (Index e = 0; e < subject.edges; ++e) table.row({subject, e, roles[e], prices[e], ec});
}

void vertex_rows(cmd::Table<VertexRow>& table, const Subject& subject) {
  const graph::Order order = order_of(subject);
  const elim::Symbolic symbolic = elim::symbolic(subject.variables.pattern, order);
  const double ec = elim::to_double(elim::elimination_complexity(symbolic));
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Index vertex = subject.variables.variable_vertex[order[k]];
    const std::int64_t frontal = symbolic.dim[k];
    table.row({subject, vertex, k, frontal, symbolic.count[k] - frontal, ec});
  }
}

using Show = std::function<void(const Subject&)>;

// The graph as it grows: calls `show` with what stands after every `every`-th step and after the
// last.
void replay_rows(const Graph& graph, const std::string& file, const Options& options,
                 const Show& show) {
  const graph::Replay replay = graph::replay(graph, graph::pose_index(graph), options.min_obs);
  const graph::Lists<> vertices = graph::grouped(replay.vertex_step, replay.steps);
  const graph::Lists<> edges = graph::grouped(replay.edge_step, replay.steps);
  std::vector<bool> vertex_in(graph.vertices(), false);
  std::vector<bool> edge_in(graph.edges(), false);
  cmd::stage("replay", replay.steps);
  for (Index k = 0; k < replay.steps && !cmd::interrupted(); ++k) {
    for (const Index v : vertices[k]) vertex_in[v] = true;
    for (const Index e : edges[k]) edge_in[e] = true;
    cmd::progress(k);
    if (k % options.every != 0 && k + 1 < replay.steps) continue;
    const graph::GraphPattern variables = graph::graph_pattern(graph, vertex_in, edge_in);
    show({options, file, k, vertices.begin[k + 1], edges.begin[k + 1], graph, variables});
  }
}

void show_file(const std::string& path, const Options& options, const Show& show) {
  const Graph graph = cmd::read(options.inputs, path);
  const std::vector<cmd::Method> methods = cmd::methods(options.methods, graph);
  const Show under_each = [&](Subject subject) {
    for (const cmd::Method& method : methods) {
      if (cmd::interrupted()) return;
      subject.method = &method;
      show(subject);
    }
  };
  if (options.trace) return replay_rows(graph, path, options, under_each);
  cmd::stage("score");
  const graph::GraphPattern variables = graph::graph_pattern(graph);
  under_each({options, path, {}, graph.vertices(), graph.edges(), graph, variables});
}

void add_options(cmd::Command& command, Options& options) {
  cmd::add_inputs(command, options.inputs);
  cmd::add_methods(command, options.methods);
  cmd::add_budget(command.app, options.methods.budget);
  auto& app = command.app;
  app.add_flag("--trace", options.trace, "A row for every step of the growing graph")
      ->option_text(" ");
  cmd::add_every(app, options.every, "With --trace:");
  cmd::add_entry(app, options.min_obs, "With --trace: a landmark");
  app.add_flag("--per-vertex", options.per_vertex, "A row for every variable, in elimination order")
      ->option_text(" ");
  app.add_flag("--per-edge", options.per_edge,
               "A row for every edge: what EC would lose without it")
      ->option_text(" ");
  cmd::add_output(command, options.output);
  cmd::add_table(command, options.table,
                 {{"", cmd::headings(score_columns)},
                  {"With --per-vertex:", cmd::headings(vertex_columns)},
                  {"With --per-edge:", cmd::headings(edge_columns)}});
}

void score(const cmd::Command& command, const Options& options) {
  cmd::check_form(command.app);
  cmd::at_most_one(command.app, {{"--trace", "prints a row a step"},
                                 {"--per-vertex", "a row a variable"},
                                 {"--per-edge", "a row an edge"}});
  if (!options.trace) cmd::refuse(command.app, {"--every", "--min-obs"}, "without --trace");
  cmd::check(options.methods);
  cmd::check_budget(command, options.methods);
  const cmd::Given given{{"several files", options.inputs.paths.size() > 1},
                         {"--trace", options.trace},
                         {"-f", false}};
  cmd::Output output(options.output.path);
  output.keep_rows();
  const auto show_files = [&](const Show& show) {
    for (const auto& path : options.inputs.paths) {
      if (!cmd::interrupted()) show_file(path, options, show);
    }
    output.commit();
  };
  if (options.per_vertex) {
    cmd::Table table(options.table, vertex_columns, given, output);
    show_files([&](const Subject& subject) { vertex_rows(table, subject); });
  } else if (options.per_edge) {
    cmd::Table table(options.table, edge_columns, given, output);
    show_files([&](const Subject& subject) { edge_rows(table, subject); });
  } else {
    cmd::Table table(options.table, score_columns, given, output);
    show_files([&](const Subject& subject) { table.row({subject}); });
  }
}

}  // namespace

int main(int argc, char** argv) {
  return cmd::run(cmd::Command("sg-ec", "Score the elimination complexity of graphs."), argc, argv,
                  add_options, score);
}
