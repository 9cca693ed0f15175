// sg-isam2: replay a graph step by step through an incremental smoother; a row a step.
#include <algorithm>
#include <cmath>

#include "cmd/common/command.h"
#include "cmd/common/complete.h"
#include "cmd/common/estimates.h"
#include "cmd/common/options.h"
#include "cmd/common/processor.h"
#include "cmd/common/table.h"
#include "cmd/isam2/online.h"
#include "cmd/isam2/timed.h"
#include "lib/elim/score.h"
#include "lib/factor/initialize.h"
#include "lib/solve/eliminate.h"
#include "lib/solve/isam2_leave.h"
#include "lib/solve/isam2_window.h"
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
  std::string order_budget;  // of best; empty: its default
  Index min_obs = 1;
  Index every = 1;
  bool from_file = false;
  bool colamd = false, chi2 = false, batch = false, sigma = false;
  solve::WindowOptions window;
  std::int64_t budget = 0;
  std::optional<double> budget_ms;
  std::string truth;
};

// As solve::Spend has them.
const std::vector<std::string> spends{"window", "measurements", "keyframes", "mixed"};

bool has_budget(const Options& options) {
  return options.budget > 0 || options.budget_ms;
}
bool lets_go(const Options& options) {
  return options.window.lag > 0 || std::isfinite(options.window.distance) || has_budget(options);
}

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
  const double start = cmd::thread_seconds();
  solve::eliminate(elimination, snapshot.system);
  return cmd::thread_seconds() - start;
}

struct Row {
  const std::string& file;
  const std::string& ordering;
  solve::Isam2Window& window;
  const solve::Isam2& isam;
  Index step;
  const solve::Isam2Report& report;
  double seconds;
  Index violations;
  std::optional<double> error;
  std::optional<Whole> whole_ = {};

  const Whole& whole() {
    return cmd::once(whole_, [&] { return ::whole(isam); });
  }
};

constexpr const char* spending_measurements = "--spend measurements";
constexpr const char* composing = "--spend keyframes or mixed";
constexpr const char* letting_go = "a lag or a budget";

const std::vector<cmd::Column<Row>> columns{
    {"file", "The file", [](Row& row) { return row.file; }, "several files"},
    {"order", "The ordering", [](Row& row) { return row.ordering; }, "several orderings"},
    {"step", "From 0", &Row::step},
    {"variables", "That are there, new ones included", [](Row& row) { return row.isam.variables; }},
    {"factors", "That are there, new ones included",
     [](Row& row) { return solve::factors(row.window); }},
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
    {"ec_step", "What the step eliminated, of ec_bt", [](Row& row) { return row.report.ec; },
     letting_go},
    {"window", "Poses that are there", [](Row& row) { return row.window.there; }, letting_go},
    {"dropped", "Edges so far that named what had left",
     [](Row& row) { return row.window.dropped; }, letting_go},
    {"offered", "Closures and observations so far",
     [](Row& row) { return row.window.admission.offered; }, spending_measurements},
    {"admitted", "Of these, those that came in",
     [](Row& row) { return row.window.admission.admitted; }, spending_measurements},
    {"returned", "Of these, those given back later",
     [](Row& row) { return row.window.admission.returned; }, spending_measurements},
    {"composed", "Poses so far that were composed",
     [](Row& row) { return row.window.keyframes.composed; }, composing},
    {"moved", "Edges so far that this has moved",
     [](Row& row) { return row.window.keyframes.moved; }, composing},
    {"budget", "Bound of ec_bt", [](Row& row) { return row.window.options.budget; }, "a budget"},
    {"violations", "Steps so far that ended above the budget", &Row::violations, "a budget"},
    {"renewed", "Steps so far that ordered the whole anew",
     [](Row& row) { return row.window.renewed; }, "--renew"},
    {"error", "Metres from the truth of the newest pose", &Row::error, "--truth"},
    {"sigma", "Standard deviation of the newest pose's position",
     [](Row& row) { return isam2::online_sigma(row.window.replay, row.step); }, "--sigma"},
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

void add_window(CLI::App& app, Options& options) {
  app.add_option("--lag", options.window.lag, "Poses stay N steps, then they are marginalized")
      ->option_text("N")
      ->transform(cmd::whole(1));
  app.add_option("--lag-distance", options.window.distance,
                 "Those leave that are over D metres back on the path")
      ->option_text("D")
      ->check(cmd::number(0));
  app.add_flag("--smooth", options.window.smooth,
               "Keep what has left, and smooth it at the end, for -o");
  app.add_option("--budget", options.budget, "No step ends with ec_bt above EC: old poses leave")
      ->option_text("EC")
      ->transform(cmd::whole(1, std::int64_t{1} << 62));
  app.add_option_function<std::string>(
         "--spend",
         [&options](const std::string& what) {
           options.window.spend = solve::Spend(std::ranges::find(spends, what) - spends.begin());
         },
         "window (default), measurements, keyframes or mixed")
      ->option_text("WHAT")
      ->check(cmd::one_of(spends));
  app.add_option("--budget-ms", options.budget_ms, "The same in milliseconds, as steps took so far")
      ->option_text("X")
      ->check(cmd::number(0));
  app.add_option("--renew", options.window.renew,
                 "Order anew where ec_bt is X times what that gives")
      ->option_text("X")
      ->check(cmd::number(1));
  app.add_option("--truth", options.truth, "Add error, from where FILE has the newest pose")
      ->option_text("FILE");
  app.add_flag("--sigma", options.sigma, "Add sigma, of the newest pose");
}

void check_window(const CLI::App& app, const Options& options) {
  cmd::at_most_one(app, {{"--budget", "bounds the complexity"}, {"--budget-ms", "the time"}});
  if (!has_budget(options)) cmd::refuse(app, {"--spend"}, "without a budget to spend");
  if (!lets_go(options))
    cmd::refuse(app, {"--smooth"}, "without --lag, --lag-distance or a budget: nothing leaves");
  if (options.output.path.empty())
    cmd::refuse(app, {"--smooth"}, "without -o, which writes what is smoothed");
  if (lets_go(options))
    cmd::refuse(app, {"--batch"}, "where poses leave: the whole is not there to be eliminated");
}

void add_options(cmd::Command& command, Options& options) {
  cmd::add_inputs(command, options.inputs);
  options.inputs.options.unknown_edge = factor::has_no_model;
  auto& app = command.app;
  app.add_option("-m,--method,--ordering", options.orderings, "A replay each (default: colamd)")
      ->check(cmd::suggests(text::names_of(order::orderings())))
      ->option_text("METHOD,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--order-budget", options.order_budget, "Of best, in every step (default: 200t)")
      ->option_text("SECONDS|Nt");
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
  add_window(app, options);
  cmd::add_output(app, options.output, "Write the final graph to FILE", cmd::Writes::graph);
  cmd::add_table(command, options.table, columns);
}

void summarize(const cmd::Command& command, const Options& options, const isam2::Summary& summary,
               const solve::Isam2Window& window) {
  if (!lets_go(options) && options.truth.empty()) return;
  for (const std::string& line : isam2::lines(summary, window, has_budget(options)))
    cmd::warn(command, line);
}

void replay(const cmd::Command& command, const std::string& file, const std::string& ordering,
            const Options& options, const std::optional<score::Trajectory>& truth,
            solve::Isam2Window& window, cmd::Table<Row>& table) {
  const Index steps = window.replay.steps.steps;
  isam2::Summary summary;
  isam2::Calibration calibration;
  cmd::stage("replay", steps);
  // Where it searches for orders, other threads do so, too.
  const auto clock =
      window.replay.isam.options.ordering == "best" ? cmd::processor_seconds : cmd::thread_seconds;
  for (Index k = 0; k < steps; ++k) {
    cmd::progress(k);
    if (options.budget_ms)
      window.options.budget =
          static_cast<elim::Wide>(isam2::ec_of(calibration, *options.budget_ms / 1e3));
    const double start = clock();
    const solve::Isam2Report report = solve::window_step(window, k);
    const double seconds = clock() - start;
    isam2::add(calibration, static_cast<double>(report.ec), seconds);
    summary.seconds.push_back(seconds);
    summary.ec.push_back(static_cast<double>(report.ec));
    if (has_budget(options) && window.replay.isam.tree.ec_bt > window.options.budget)
      ++summary.violations;
    std::optional<double> error;
    if (truth) error = isam2::online_error(window.replay, *truth, k);
    if (error) summary.error.push_back(*error);
    if (k % options.every != 0 && k + 1 < steps) continue;
    table.row({file, ordering, window, window.replay.isam, k, report, seconds, summary.violations,
               error});
  }
  summarize(command, options, summary, window);
}

// Vertices that never entered stay where they were.
void write_graph(const cmd::Command& command, const Options& options,
                 const factor::Problem& problem, solve::Isam2Window& window) {
  solve::Isam2Replay& replay = window.replay;
  if (options.window.smooth) solve::smooth_past(replay.isam);
  solve::place_composed(replay, window.keyframes);
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
              const std::optional<score::Trajectory>& truth, cmd::Table<Row>& table) {
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
    if (!options.order_budget.empty())
      isam.order_budget = order::parse_budget(options.order_budget, "--order-budget");
    solve::WindowOptions window = options.window;
    window.budget = static_cast<elim::Wide>(options.budget);
    solve::Isam2Window state =
        solve::make_isam2_window(problem, isam, options.min_obs, options.from_file, window);
    replay(command, path, ordering, options, truth, state, table);
    if (!options.output.path.empty()) write_graph(command, options, problem, state);
  }
}

void run(const cmd::Command& command, const Options& options) {
  solve::kernels();  // a wrong call is told before a long read
  cmd::check_form(command.app);
  check_window(command.app, options);
  for (const std::string& ordering : options.orderings) order::find_ordering(ordering);
  if (std::ranges::find(options.orderings, "best") == options.orderings.end())
    cmd::refuse(command.app, {"--order-budget"}, "without -m best");
  if (!options.order_budget.empty()) order::parse_budget(options.order_budget, "--order-budget");
  const bool several = options.inputs.paths.size() > 1;
  const bool several_orderings = options.orderings.size() > 1;
  if (several || several_orderings)
    cmd::refuse(command.app, {"-o"}, "with several files or orderings: one graph goes to one file");
  cmd::Output output("");
  const cmd::Given given{
      {"several files", several},
      {"several orderings", several_orderings},
      {"--colamd", options.colamd},
      {"--chi2", options.chi2},
      {"--batch", options.batch},
      {letting_go, lets_go(options)},
      {spending_measurements, options.window.spend == solve::Spend::measurements},
      {composing, options.window.spend == solve::Spend::keyframes ||
                      options.window.spend == solve::Spend::mixed},
      {"a budget", has_budget(options)},
      {"--renew", options.window.renew > 0},
      {"--truth", !options.truth.empty()},
      {"--sigma", options.sigma}};
  cmd::Table table(options.table, columns, given, output);
  std::optional<score::Trajectory> truth;
  if (!options.truth.empty()) truth = score::trajectory(cmd::read(options.inputs, options.truth));
  for (const std::string& path : options.inputs.paths)
    run_file(command, options, path, truth, table);
  output.commit();
}

}  // namespace

int main(int argc, char** argv) {
  return cmd::run(
      cmd::Command("sg-isam2", "Replay a graph step by step through iSAM2; a row a step."), argc,
      argv, add_options, run);
}
