// sg-ec: what a graph costs to eliminate; over time with --trace, by variable with --per-vertex.
#include <numeric>

#include "cmd/common/command.h"
#include "cmd/common/method.h"
#include "cmd/common/options.h"
#include "cmd/common/progress.h"
#include "cmd/common/table.h"
#include "lib/elim/bayes_tree.h"
#include "lib/graph/lists.h"
#include "lib/graph/replay.h"

namespace {

struct Options {
  sg::Inputs inputs;
  sg::OutputOptions output;
  sg::TableOptions table;
  sg::MethodOptions methods;
  bool trace = false;
  sg::Index every = 1;
  sg::Index min_obs = 1;
  bool per_vertex = false;
};

// A graph, or the part of it that has entered by some step, under one order.
struct Subject {
  const Options& options;
  const std::string& file;
  std::optional<sg::Index> step;
  sg::Index vertices;
  sg::Index edges;
  const sg::Graph& graph;
  const sg::GraphPattern& variables;
  const sg::Method* method = nullptr;
};

sg::Order order_of(const Subject& subject) {
  return sg::order_by(*subject.method, subject.options.methods, subject.graph, subject.variables);
}

struct ScoreRow {
  const Subject& subject;
  std::optional<sg::Symbolic> symbolic_ = {};
  std::optional<sg::Score> score_ = {};
  std::optional<sg::BayesTree> tree_ = {};

  const sg::Pattern& pattern() const { return subject.variables.pattern; }
  const sg::Symbolic& symbolic() {
    return sg::once(symbolic_, [&] { return sg::symbolic(pattern(), order_of(subject)); });
  }
  const sg::Score& score() {
    return sg::once(score_, [&] { return sg::column_score(symbolic()); });
  }
  const sg::BayesTree& tree() {
    return sg::once(tree_, [&] { return sg::bayes_tree(symbolic()); });
  }
};

struct VertexRow {
  const Subject& subject;
  sg::Index vertex;
  std::size_t position;
  std::int64_t frontal;
  std::int64_t separator;
  double ec;

  sg::Wide cost() const { return sg::elimination_cost(frontal, frontal + separator); }
};

template <class Row>
sg::Column<Row> file_column() {
  return {"file", "The file", [](Row& row) { return row.subject.file; }, "several files"};
}

template <class Row>
sg::Column<Row> order_column() {
  return {"order", "The ordering; file:NAME is the one that sg-order left",
          [](Row& row) { return row.subject.method->label; }};
}

const std::vector<sg::Column<ScoreRow>> score_columns{
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
     [](ScoreRow& row) { return row.score().nnz - sg::system_nnz(row.pattern()); }},
    {"max_clique", "The largest d_f + d_s", [](ScoreRow& row) { return row.score().max_clique; }},
    {"height", "Variables on the longest path of the elimination tree",
     [](ScoreRow& row) { return row.score().height; }},
    {"cliques", "Cliques of the Bayes tree", [](ScoreRow& row) { return row.tree().cliques(); }},
    {"ec_bt", "Elimination complexity of the Bayes tree: the sum over cliques",
     [](ScoreRow& row) { return sg::elimination_complexity(row.tree()); }},
};

const std::vector<sg::Column<VertexRow>> vertex_columns{
    file_column<VertexRow>(),
    order_column<VertexRow>(),
    {"id", "Of the vertex", [](VertexRow& row) { return row.subject.graph.id[row.vertex]; }},
    {"tag", "Its type",
     [](VertexRow& row) { return row.subject.graph.type_of_vertex(row.vertex).tag; }},
    {"role", "pose, landmark or other",
     [](VertexRow& row) { return sg::name(row.subject.graph.role(row.vertex)); }},
    {"position", "In the order, from 0", &VertexRow::position},
    {"d_f", "Its scalar dimension", &VertexRow::frontal},
    {"d_s", "Scalar dimension of its separator", &VertexRow::separator},
    {"cost", "d_f (d_f + d_s)^2", [](VertexRow& row) { return row.cost(); }},
    {"share", "Of EC", [](VertexRow& row) { return sg::to_double(row.cost()) / row.ec; }},
};

void vertex_rows(sg::Table<VertexRow>& table, const Subject& subject) {
  const sg::Order order = order_of(subject);
  const sg::Symbolic symbolic = sg::symbolic(subject.variables.pattern, order);
  const double ec = sg::to_double(sg::elimination_complexity(symbolic));
  for (std::size_t k = 0; k < order.size(); ++k) {
    const sg::Index vertex = subject.variables.variable_vertex[order[k]];
    const std::int64_t frontal = symbolic.dim[k];
    table.row({subject, vertex, k, frontal, symbolic.count[k] - frontal, ec});
  }
}

using Show = std::function<void(const Subject&)>;

// The graph as it grows: calls `show` with what stands after every `every`-th step and after the
// last.
void replay_rows(const sg::Graph& graph, const std::string& file, const Options& options,
                 const Show& show) {
  const sg::Replay replay = sg::replay(graph, sg::pose_index(graph), options.min_obs);
  const sg::Lists<> vertices = sg::grouped(replay.vertex_step, replay.steps);
  const sg::Lists<> edges = sg::grouped(replay.edge_step, replay.steps);
  std::vector<bool> vertex_in(graph.vertices(), false);
  std::vector<bool> edge_in(graph.edges(), false);
  sg::Progress progress("sg-ec", "step", replay.steps);
  for (sg::Index k = 0; k < replay.steps; ++k) {
    for (const sg::Index v : vertices[k]) vertex_in[v] = true;
    for (const sg::Index e : edges[k]) edge_in[e] = true;
    progress.update(k);
    if (k % options.every != 0 && k + 1 < replay.steps) continue;
    const sg::GraphPattern variables = sg::graph_pattern(graph, vertex_in, edge_in);
    show({options, file, k, vertices.begin[k + 1], edges.begin[k + 1], graph, variables});
  }
}

void show_file(const std::string& path, const Options& options, const Show& show) {
  const sg::Graph graph = sg::read(options.inputs, path);
  const std::vector<sg::Method> methods = sg::methods(options.methods, graph);
  const Show under_each = [&](Subject subject) {
    for (const sg::Method& method : methods) {
      subject.method = &method;
      show(subject);
    }
  };
  if (options.trace) return replay_rows(graph, path, options, under_each);
  const sg::GraphPattern variables = sg::graph_pattern(graph);
  under_each({options, path, {}, graph.vertices(), graph.edges(), graph, variables});
}

void add_options(sg::Command& command, Options& options) {
  sg::add_inputs(command, options.inputs);
  sg::add_methods(command, options.methods);
  auto& app = command.app;
  auto* trace = app.add_flag("--trace", options.trace, "A row for every step of the growing graph")
                    ->option_text(" ");
  sg::add_every(app, options.every, "With --trace:")->needs(trace);
  sg::add_entry(app, options.min_obs, "With --trace: a landmark")->needs(trace);
  app.add_flag("--per-vertex", options.per_vertex, "A row for every variable, in elimination order")
      ->excludes(trace)
      ->option_text(" ");
  sg::add_output(command, options.output);
  sg::add_table(
      command, options.table,
      {{"", sg::headings(score_columns)}, {"With --per-vertex:", sg::headings(vertex_columns)}});
}

void score(const sg::Command& /*command*/, const Options& options) {
  sg::check(options.methods);
  const sg::Given given{{"several files", options.inputs.paths.size() > 1},
                        {"--trace", options.trace}};
  sg::Output output(options.output.path);
  const auto show_files = [&](const Show& show) {
    for (const auto& path : options.inputs.paths) show_file(path, options, show);
    output.commit();
  };
  if (options.per_vertex) {
    sg::Table table(options.table, vertex_columns, given, output);
    show_files([&](const Subject& subject) { vertex_rows(table, subject); });
  } else {
    sg::Table table(options.table, score_columns, given, output);
    show_files([&](const Subject& subject) { table.row({subject}); });
  }
}

}  // namespace

int main(int argc, char** argv) {
  return sg::run(sg::Command("sg-ec", "Score the elimination complexity of graphs."), argc, argv,
                 add_options, score);
}
