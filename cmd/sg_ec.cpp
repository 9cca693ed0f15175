// sg-ec: what a graph costs to eliminate; over time with --trace, by variable with --per-vertex.
#include <algorithm>

#include "cmd/common/command.h"
#include "cmd/common/method.h"
#include "cmd/common/progress.h"
#include "cmd/common/table.h"
#include "lib/elim/score.h"
#include "lib/graph/lists.h"
#include "lib/graph/replay.h"

namespace {

using Names = std::vector<std::string_view>;

const Names score_columns{"file", "step",       "order",  "vertices", "edges",
                          "dim",  "ec",         "rose",   "flops",    "nnz",
                          "fill", "max_clique", "height", "cliques",  "ec_bt"};
const Names vertex_columns{"file",     "order", "id",  "tag",  "role",
                           "position", "d_f",   "d_s", "cost", "share"};

struct Options {
  sg::Inputs inputs;
  sg::OutputOptions output;
  sg::TableOptions table;
  sg::MethodOptions methods;
  bool trace = false;
  sg::Index every = 1;
  int min_obs = 1;
  bool per_vertex = false;
};

// A graph, or the part of it that has entered by some step.
struct Subject {
  const std::string& file;
  sg::Cell step;
  sg::Index vertices;
  sg::Index edges;
  const sg::Graph& graph;
  const sg::GraphPattern& variables;
};

bool wants_any(const sg::Table& table, const Names& names) {
  return std::any_of(names.begin(), names.end(), [&](auto name) { return table.wants(name); });
}

std::int64_t total_dim(const sg::Pattern& pattern) {
  std::int64_t sum = 0;
  for (const int dim : pattern.dim) sum += dim;
  return sum;
}

void score_row(sg::Table& table, const Subject& subject, const sg::Method& method,
               const Options& options) {
  const sg::Pattern& pattern = subject.variables.pattern;
  sg::Score score;
  const bool tree = wants_any(table, {"cliques", "ec_bt"});
  if (tree || wants_any(table, {"ec", "rose", "flops", "nnz", "fill", "max_clique", "height"})) {
    const sg::Symbolic symbolic = sg::symbolic(
        pattern, sg::order_by(method, options.methods, subject.graph, subject.variables));
    score = tree ? sg::score(symbolic) : sg::column_score(symbolic);
  }
  const sg::Wide fill = table.wants("fill") ? score.nnz - sg::system_nnz(pattern) : 0;
  table.row({subject.file, subject.step, method.label, std::int64_t{subject.vertices},
             std::int64_t{subject.edges}, total_dim(pattern), score.ec, score.rose, score.flops,
             score.nnz, fill, score.max_clique, std::int64_t{score.height},
             std::int64_t{score.cliques}, score.ec_bt});
}

void vertex_rows(sg::Table& table, const Subject& subject, const sg::Method& method,
                 const Options& options) {
  const sg::Order order = sg::order_by(method, options.methods, subject.graph, subject.variables);
  const sg::Symbolic symbolic = sg::symbolic(subject.variables.pattern, order);
  const double ec = sg::to_double(sg::elimination_complexity(symbolic));
  for (std::size_t k = 0; k < order.size(); ++k) {
    const sg::Index v = subject.variables.variable_vertex[order[k]];
    const std::int64_t frontal = symbolic.dim[k];
    const sg::Wide cost = sg::elimination_cost(frontal, symbolic.count[k]);
    table.row({subject.file, method.label, subject.graph.id[v], subject.graph.type_of_vertex(v).tag,
               std::string(sg::name(subject.graph.role(v))), static_cast<std::int64_t>(k), frontal,
               symbolic.count[k] - frontal, cost, sg::to_double(cost) / ec});
  }
}

// The graph as it grows: calls `row` with what stands after every `every`-th step and after the
// last.
void replay_rows(const sg::Graph& graph, const std::string& file, const Options& options,
                 const std::function<void(const Subject&)>& row) {
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
    row({file, std::int64_t{k}, vertices.begin[k + 1], edges.begin[k + 1], graph, variables});
  }
}

void score_file(sg::Table& table, const std::string& path, const Options& options) {
  const sg::Graph graph = sg::read(options.inputs, path);
  const std::vector<sg::Method> methods = sg::methods(options.methods, graph);
  const auto rows = [&](const Subject& subject) {
    for (const sg::Method& method : methods)
      (options.per_vertex ? vertex_rows : score_row)(table, subject, method, options);
  };
  if (options.trace) return replay_rows(graph, path, options, rows);
  const sg::GraphPattern variables = sg::graph_pattern(graph);
  rows({path, {}, graph.vertices(), graph.edges(), graph, variables});
}

// All columns, without `file` where there is one file, and without `step` where there is no time.
sg::TableOptions with_default_columns(const Options& options, const Names& names) {
  sg::TableOptions table = options.table;
  if (!table.columns.empty()) return table;
  for (const auto name : names) {
    if (name == "file" && options.inputs.paths.size() < 2) continue;
    if (name == "step" && !options.trace) continue;
    table.columns.emplace_back(name);
  }
  return table;
}

void add_options(sg::Command& command, Options& options) {
  sg::add_inputs(command, options.inputs);
  sg::add_methods(command, options.methods);
  auto& app = command.app;
  auto* trace = app.add_flag("--trace", options.trace, "A row for every step of the growing graph")
                    ->option_text(" ");
  app.add_option("--every", options.every, "With --trace: every K-th step, and the last")
      ->needs(trace)
      ->check(CLI::PositiveNumber)
      ->option_text("K");
  app.add_option("--min-obs", options.min_obs,
                 "With --trace: a landmark enters with its\nM-th observation (default: 1)")
      ->needs(trace)
      ->check(CLI::PositiveNumber)
      ->option_text("M");
  app.add_flag("--per-vertex", options.per_vertex, "A row for every variable, in elimination order")
      ->excludes(trace)
      ->option_text(" ");
  sg::add_output(command, options.output);
  sg::add_table(command, options.table, score_columns);
}

}  // namespace

int main(int argc, char** argv) {
  sg::Command command("sg-ec", "Score the elimination complexity of graphs.");
  Options options;
  add_options(command, options);
  return sg::run(command, argc, argv, [&] {
    sg::check(options.methods);
    const Names& names = options.per_vertex ? vertex_columns : score_columns;
    sg::Output output(options.output.path);
    sg::Table table(with_default_columns(options, names), names, output);
    for (const auto& path : options.inputs.paths) score_file(table, path, options);
    output.commit();
  });
}
