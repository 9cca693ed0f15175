// sg-isam2: replay a graph step by step through an incremental smoother; a row a step.
#include "cmd/common/command.h"
#include "cmd/common/complete.h"
#include "cmd/common/estimates.h"
#include "cmd/common/options.h"
#include "cmd/common/table.h"
#include "cmd/isam2/timed.h"
#include "lib/elim/score.h"
#include "lib/factor/initialize.h"
#include "lib/solve/eliminate.h"
#include "lib/solve/isam2_replay.h"
#include "lib/solve/snapshot.h"
#include "lib/text/nearest.h"

using namespace sg;

namespace {

struct Options {
  cmd::Inputs inputs;
  cmd::OutputOptions output;
  cmd::TableOptions table;
  solve::Isam2Options isam;
  std::vector<std::string> orderings{isam.ordering};
  Index min_obs = 1;
  Index every = 1;
  bool from_file = false;
  bool colamd = false, chi2 = false, batch = false;
};

// What the whole graph costs in batch, in COLAMD's order.
struct Whole {
  graph::Order order;
  elim::Wide ec;
};

Whole whole(const solve::Isam2& isam) {
  solve::Snapshot snapshot;
  solve::take_snapshot(isam, false, snapshot);
  graph::Order order = order::elimination_order(order::default_ordering, snapshot.pattern);
  const elim::Wide ec = elim::elimination_complexity(snapshot.pattern, order);
  return {std::move(order), ec};
}

double elimination_seconds(const solve::Isam2& isam, const graph::Order& order) {
  solve::Snapshot snapshot;
  solve::take_snapshot(isam, true, snapshot);
  solve::Elimination elimination = solve::plan_elimination(snapshot.system, order);
  const double start = isam2::processor_seconds();
  solve::eliminate(elimination, snapshot.system);
  return isam2::processor_seconds() - start;
}

struct Row {
  const std::string& file;
  const std::string& ordering;
  const solve::Isam2& isam;
  Index step;
  Index factors;
  const solve::Isam2Report& report;
  double seconds;
  std::optional<Whole> whole_ = {};

  const Whole& whole() {
    return cmd::once(whole_, [&] { return ::whole(isam); });
  }
};

const std::vector<cmd::Column<Row>> columns{
    {"file", "The file", [](Row& row) { return row.file; }, "several files"},
    {"order", "The ordering", [](Row& row) { return row.ordering; }, "several orderings"},
    {"step", "From 0", &Row::step},
    {"variables", "That are there, new ones included", [](Row& row) { return row.isam.variables; }},
    {"factors", "That are there, new ones included", &Row::factors},
    {"ec_bt", "Elimination complexity of the Bayes tree",
     [](Row& row) { return row.isam.tree.ec_bt; }},
    {"ec_colamd", "EC of the whole graph in COLAMD's order",
     [](Row& row) { return row.whole().ec; }, "--colamd"},
    {"update_s", "Processor seconds of the step", &Row::seconds},
    {"reeliminated", "Variables that were eliminated anew, new ones included",
     [](Row& row) { return row.report.reeliminated; }},
    {"relinearized", "Variables whose linearization point moved",
     [](Row& row) { return row.report.relinearized; }},
    {"cliques", "Of the Bayes tree", [](Row& row) { return row.isam.tree.count; }},
    {"chi2", "Of the factors, at the estimate", [](Row& row) { return solve::chi2(row.isam); },
     "--chi2"},
    {"batch_s", "Processor seconds to eliminate the whole system",
     [](Row& row) { return elimination_seconds(row.isam, row.whole().order); }, "--batch"},
};

void add_thresholds(CLI::App& app, solve::Isam2Options& isam) {
  app.add_option("--relinearize-threshold", isam.relinearize_threshold,
                 "Relinearize vertices X or more away (default: 0.1)")
      ->option_text("X")
      ->check(cmd::number(0));
  app.add_option("--relinearize-skip", isam.relinearize_skip,
                 "Do so in every N-th step; 0: never (default: 1)")
      ->option_text("N")
      ->transform(cmd::whole(0));
  app.add_option("--wildfire-threshold", isam.wildfire_threshold,
                 "Pass on changes of X or more (default: 0.001)")
      ->option_text("X")
      ->check(cmd::number(0));
}

void add_options(cmd::Command& command, Options& options) {
  cmd::add_inputs(command, options.inputs);
  options.inputs.options.unknown_edge = factor::has_no_model;
  auto& app = command.app;
  app.add_option("-m,--method,--ordering", options.orderings,
                 "Orderings to eliminate anew by, a replay each\n(default: colamd)")
      ->check(cmd::suggests(text::names_of(order::orderings())))
      ->option_text("METHOD,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_thresholds(app, options.isam);
  cmd::add_entry(app, options.min_obs, "A landmark");
  app.add_option_function<std::string>(
         "--init", [&options](const std::string& from) { options.from_file = from == "file"; },
         "Start from the edges (default) or the file")
      ->option_text("edges|file")
      ->check(cmd::one_of({"edges", "file"}));
  cmd::add_every(app, options.every, "A row for");
  app.add_flag("--colamd", options.colamd, "Add ec_colamd: the EC of the whole, by COLAMD");
  app.add_flag("--chi2", options.chi2, "Add chi2, at the estimate");
  app.add_flag("--batch", options.batch, "Add batch_s: time the elimination of the whole");
  cmd::add_output(app, options.output, "Write the final graph to FILE", cmd::Writes::graph);
  cmd::add_table(command, options.table, columns);
}

void replay(const std::string& file, const std::string& ordering, const Options& options,
            solve::Isam2Replay& replay, cmd::Table<Row>& table) {
  cmd::stage("replay", replay.steps.steps);
  for (Index k = 0; k < replay.steps.steps; ++k) {
    cmd::progress(k);
    const auto [report, seconds] = isam2::timed_step(replay, k);
    if (k % options.every != 0 && k + 1 < replay.steps.steps) continue;
    table.row({file, ordering, replay.isam, k, replay.edges.begin[k + 1], report, seconds});
  }
}

// Vertices that never entered stay where they were.
void write_graph(const cmd::Command& command, const Options& options,
                 const factor::Problem& problem, const solve::Isam2Replay& replay) {
  factor::Values values = factor::start_values(problem);
  std::vector<bool> moved(problem.graph->vertices(), false);
  for (Index v = 0; v < problem.graph->vertices(); ++v) {
    const Index j = problem.variables.vertex_variable[v];
    if (!replay.placed[v] || j < 0) continue;
    moved[v] = !factor::is_held(problem, j);
    std::copy(replay.isam.estimate.begin() + problem.value_at[v],
              replay.isam.estimate.begin() + problem.value_at[v + 1],
              values.begin() + problem.value_at[v]);
  }
  cmd::write_filtered(command, options.output, *problem.graph,
                      cmd::estimate_changes(problem, values, moved));
}

void run_file(const cmd::Command& command, const Options& options, const std::string& path,
              cmd::Table<Row>& table) {
  const Graph graph = cmd::read(options.inputs, path);
  cmd::stage("start");
  factor::Problem problem = factor::make_problem(graph);
  if (isam2::hold_at_first(problem))
    cmd::warn(
        command,
        "the first pose is held, since nothing holds it in the first step; sg-solve lets go of "
        "it, since later edges hold the whole");
  for (const std::string& ordering : options.orderings) {
    solve::Isam2Options isam = options.isam;
    isam.ordering = ordering;
    solve::Isam2Replay state =
        solve::make_isam2_replay(problem, isam, options.min_obs, options.from_file);
    replay(path, ordering, options, state, table);
    if (!options.output.path.empty()) write_graph(command, options, problem, state);
  }
}

void run(const cmd::Command& command, const Options& options) {
  solve::kernels();  // a wrong call is told before a long read
  cmd::check_form(command.app);
  for (const std::string& ordering : options.orderings) order::find_ordering(ordering);
  const bool several = options.inputs.paths.size() > 1;
  const bool several_orderings = options.orderings.size() > 1;
  if (several || several_orderings)
    cmd::refuse(command.app, {"-o"}, "with several files or orderings: one graph goes to one file");
  cmd::Output output("");
  const cmd::Given given{{"several files", several},
                         {"several orderings", several_orderings},
                         {"--colamd", options.colamd},
                         {"--chi2", options.chi2},
                         {"--batch", options.batch}};
  cmd::Table table(options.table, columns, given, output);
  for (const std::string& path : options.inputs.paths) run_file(command, options, path, table);
  output.commit();
}

}  // namespace

int main(int argc, char** argv) {
  return cmd::run(
      cmd::Command("sg-isam2", "Replay a graph step by step through iSAM2; a row a step."), argc,
      argv, add_options, run);
}
