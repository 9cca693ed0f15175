// sg-ec: what a graph costs to eliminate; over time with --trace, by variable with --per-vertex, by edge with --per-edge.
#include "cmd/common/command.h"
#include "cmd/common/method.h"
#include "cmd/common/options.h"
#include "cmd/common/table.h"
#include "cmd/ec/columns.h"
#include "lib/graph/lists.h"
#include "lib/graph/replay.h"

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

using Show = std::function<void(const ec::Subject&)>;

// The graph as it grows: calls `show` with what stands after every `every`-th step and after the
// last.
void replay_rows(const Graph& graph, const std::string& file, const Options& options,
                 const Show& show) {
  const graph::Replay replay = graph::replay(graph, graph::pose_index(graph), options.min_obs);
  cmd::stage("replay", replay.steps);
  graph::grow(graph, replay, [&](const graph::Grown& grown) {
    cmd::progress(grown.step);
    if (grown.step % options.every == 0 || grown.step + 1 == replay.steps) {
      const graph::GraphPattern variables =
          graph::graph_pattern(graph, grown.vertex_in, grown.edge_in);
      show({options.methods, file, grown.step, grown.vertices, grown.edges, graph, variables});
    }
    return !cmd::interrupted();
  });
}

void show_file(const std::string& path, const Options& options, const Show& show) {
  const Graph graph = cmd::read(options.inputs, path);
  const std::vector<cmd::Method> methods = cmd::methods(options.methods, graph);
  const Show under_each = [&](ec::Subject subject) {
    for (const cmd::Method& method : methods) {
      if (cmd::interrupted()) return;
      subject.method = &method;
      show(subject);
    }
  };
  if (options.trace) return replay_rows(graph, path, options, under_each);
  cmd::stage("score");
  const graph::GraphPattern variables = graph::graph_pattern(graph);
  under_each({options.methods, path, {}, graph.vertices(), graph.edges(), graph, variables});
}

void add_options(cmd::Command& command, Options& options) {
  cmd::add_inputs(command, options.inputs);
  cmd::add_methods(command, options.methods);
  cmd::add_best(command, options.methods.best);
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
                 {{"", cmd::headings(ec::score_columns)},
                  {"With --per-vertex:", cmd::headings(ec::vertex_columns)},
                  {"With --per-edge:", cmd::headings(ec::edge_columns)}});
}

void score(const cmd::Command& command, const Options& options) {
  cmd::check_form(command.app);
  cmd::at_most_one(command.app, {{"--trace", "prints a row a step"},
                                 {"--per-vertex", "a row a variable"},
                                 {"--per-edge", "a row an edge"}});
  if (!options.trace) cmd::refuse(command.app, {"--every", "--min-obs"}, "without --trace");
  cmd::check(options.methods);
  cmd::check_best(command, cmd::asks_for_best(options.methods), options.methods.best);
  const cmd::Given given{{"several files", options.inputs.paths.size() > 1},
                         {"--trace", options.trace}};
  cmd::Output output(options.output.path);
  output.keep_rows();
  const auto show_files = [&](const Show& show) {
    for (const auto& path : options.inputs.paths) {
      if (!cmd::interrupted()) show_file(path, options, show);
    }
    output.commit();
  };
  if (options.per_vertex) {
    cmd::Table table(options.table, ec::vertex_columns, given, output);
    show_files([&](const ec::Subject& subject) {
      ec::vertex_rows(subject, [&](const ec::VertexRow& row) { table.row(row); });
    });
  } else if (options.per_edge) {
    cmd::Table table(options.table, ec::edge_columns, given, output);
    show_files([&](const ec::Subject& subject) {
      ec::edge_rows(subject, [&](const ec::EdgeRow& row) { table.row(row); });
    });
  } else {
    cmd::Table table(options.table, ec::score_columns, given, output);
    show_files([&](const ec::Subject& subject) { table.row(ec::ScoreRow{subject}); });
  }
}

}  // namespace

int main(int argc, char** argv) {
  return cmd::run(cmd::Command("sg-ec", "Score the elimination complexity of graphs."), argc, argv,
                  add_options, score);
}
