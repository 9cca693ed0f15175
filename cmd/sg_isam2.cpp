// sg-isam2: incremental optimization.
#include <ctime>

#include "cmd/common/command.h"
#include "cmd/common/estimates.h"
#include "cmd/common/progress.h"
#include "cmd/common/table.h"
#include "lib/elim/score.h"
#include "lib/factor/initialize.h"
#include "lib/solve/eliminate.h"
#include "lib/solve/isam2_replay.h"
#include "lib/solve/snapshot.h"

namespace {

const std::vector<std::string_view> columns{
    "step",         "variables",    "factors", "ec_bt", "ec_colamd", "update_s",
    "reeliminated", "relinearized", "cliques", "chi2",  "batch_s"};

struct Options {
  sg::Input input;
  std::string output;
  sg::TableOptions table;
  sg::Isam2Options isam;
  int min_obs = 1;
  int every = 1;
  bool from_file = false;
  bool colamd = false, chi2 = false, batch = false;
};

void add_thresholds(CLI::App& app, sg::Isam2Options& isam) {
  app.add_option("--relinearize-threshold", isam.relinearize_threshold,
                 "Relinearize vertices X or more away (default: 0.1)")
      ->option_text("X")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--relinearize-skip", isam.relinearize_skip,
                 "Do so in every N-th step; 0: never (default: 1)")
      ->option_text("N")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--wildfire-threshold", isam.wildfire_threshold,
                 "Pass on changes of X or more (default: 0.001)")
      ->option_text("X")
      ->check(CLI::NonNegativeNumber);
}

void add_options(sg::Command& command, Options& options) {
  sg::add_input(command, options.input);
  auto& app = command.app;
  app.add_option("-m,--method,--ordering", options.isam.ordering,
                 "Ordering to eliminate anew by (default: colamd)")
      ->option_text("METHOD");
  add_thresholds(app, options.isam);
  app.add_option("--min-obs", options.min_obs, "Landmarks enter when seen M times (default: 1)")
      ->option_text("M")
      ->check(CLI::PositiveNumber);
  app.add_option_function<std::string>(
         "--init", [&options](const std::string& from) { options.from_file = from == "file"; },
         "Start from the edges (default) or the file")
      ->option_text("edges|file")
      ->check(CLI::IsMember({"edges", "file"}));
  app.add_option("--every", options.every, "A row for every K-th step, and the last")
      ->option_text("K")
      ->check(CLI::PositiveNumber);
  app.add_flag("--colamd", options.colamd, "Add ec_colamd: the EC of the whole, by COLAMD");
  app.add_flag("--chi2", options.chi2, "Add chi2, at the estimate");
  app.add_flag("--batch", options.batch, "Add batch_s: time the elimination of the whole");
  app.add_option("-o,--output", options.output, "Write the final graph to FILE")
      ->option_text("FILE");
  sg::add_table(command, options.table, columns);
}

// All columns but those that cost time, unless these were asked for.
sg::TableOptions with_default_columns(const Options& options) {
  sg::TableOptions table = options.table;
  if (!table.columns.empty()) return table;
  for (const auto name : columns) {
    const bool unasked = (name == "ec_colamd" && !options.colamd) ||
                         (name == "chi2" && !options.chi2) || (name == "batch_s" && !options.batch);
    if (!unasked) table.columns.emplace_back(name);
  }
  return table;
}

// Processor time: what other programs on the machine do does not count, and a step of a millisecond
// that is interrupted for ten stays a step of a millisecond.
double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// What the whole graph costs in batch after a step, in COLAMD's order: EC, and, if wanted, seconds.
struct Batch {
  sg::Cell ec, seconds;
};

Batch batch(const sg::Isam2& isam, const sg::Table& table) {
  Batch result;
  const bool time = table.wants("batch_s");
  if (!time && !table.wants("ec_colamd")) return result;
  sg::Snapshot snapshot;
  sg::take_snapshot(isam, time, snapshot);
  const sg::Order order = sg::elimination_order("colamd", snapshot.pattern);
  result.ec = sg::elimination_complexity(snapshot.pattern, order);
  if (!time) return result;
  sg::Elimination elimination = sg::plan_elimination(snapshot.system, order);
  const double start = processor_seconds();
  sg::eliminate(elimination, snapshot.system);
  result.seconds = processor_seconds() - start;
  return result;
}

void replay(const sg::Command& command, const Options& options, sg::Isam2Replay& replay,
            sg::Table& table) {
  sg::Progress progress(command.name, "step", replay.steps.steps);
  for (sg::Index k = 0; k < replay.steps.steps; ++k) {
    progress.update(k);
    const double start = processor_seconds();
    const sg::Isam2Report report = sg::replay_step(replay, k);
    const double seconds = processor_seconds() - start;
    if (k % options.every != 0 && k + 1 < replay.steps.steps) continue;
    const sg::Isam2& isam = replay.isam;
    const Batch whole = batch(isam, table);
    sg::Cell chi2;
    if (table.wants("chi2")) chi2 = sg::chi2(isam);
    table.row({std::int64_t{k}, std::int64_t{isam.variables},
               std::int64_t{replay.edges.begin[k + 1]}, isam.ec_bt, whole.ec, seconds,
               std::int64_t{report.reeliminated}, std::int64_t{report.relinearized},
               std::int64_t{isam.clique_count}, chi2, whole.seconds});
  }
}

// Vertices that never entered stay where they were.
void write_graph(const sg::Command& command, const Options& options, const sg::Problem& problem,
                 const sg::Isam2Replay& replay) {
  sg::Values values = sg::start_values(problem);
  std::vector<bool> moved(problem.graph->vertices(), false);
  for (sg::Index v = 0; v < problem.graph->vertices(); ++v) {
    const sg::Index j = problem.variables.vertex_variable[v];
    if (!replay.placed[v] || j < 0) continue;
    moved[v] = j != problem.held;
    std::copy(replay.isam.estimate.begin() + problem.value_at[v],
              replay.isam.estimate.begin() + problem.value_at[v + 1],
              values.begin() + problem.value_at[v]);
  }
  sg::OutputOptions output;
  output.path = options.output;
  sg::write_filtered(command, output, *problem.graph, sg::estimate_changes(problem, values, moved));
}

void run(const sg::Command& command, const Options& options) {
  const sg::Graph graph = sg::read(options.input);
  const sg::Problem problem = sg::make_problem(graph);
  sg::Isam2Replay state =
      sg::make_isam2_replay(problem, options.isam, options.min_obs, options.from_file);
  sg::Output output("");
  sg::Table table(with_default_columns(options), columns, output);
  try {
    replay(command, options, state, table);
  } catch (const sg::Error&) {
    output.commit();  // the steps before are valid
    throw;
  }
  if (!options.output.empty()) write_graph(command, options, problem, state);
  output.commit();
}

}  // namespace

int main(int argc, char** argv) {
  sg::Command command("sg-isam2", "Replay a graph step by step through iSAM2; a row a step.");
  Options options;
  add_options(command, options);
  return sg::run(command, argc, argv, [&] { run(command, options); });
}
