// sg-solve: optimize a graph in batch; or time its elimination, or tell its chi-square.
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <unistd.h>

#include <chrono>
#include <optional>

#include "cmd/common/calibration.h"
#include "cmd/common/command.h"
#include "cmd/common/complete.h"
#include "cmd/common/estimates.h"
#include "cmd/common/method.h"
#include "cmd/common/options.h"
#include "cmd/common/ranges.h"
#include "cmd/common/same_file.h"
#include "cmd/common/table.h"
#include "cmd/solving/calibrate.h"
#include "cmd/solving/certificate.h"
#include "cmd/solving/plan.h"
#include "cmd/solving/prior.h"
#include "cmd/solving/residuals.h"
#include "cmd/solving/robust.h"
#include "cmd/solving/timing.h"
#include "lib/factor/initialize.h"
#include "lib/solve/batch.h"
#include "lib/solve/best_start.h"
#include "lib/solve/front.h"
#include "lib/solve/start.h"
#include "lib/text/nearest.h"
#include "lib/text/words.h"

using namespace sg;

namespace {

struct Options {
  cmd::Inputs inputs;
  cmd::OutputOptions output;
  cmd::TableOptions table;
  bool gauss_newton = false;
  std::optional<int> iterations;  // as many, whether that is enough or not
  double tolerance = 1e-9;
  solving::RobustOptions robust;
  cmd::MethodOptions method;
  std::string backend{solve::backends().front().name};
  int threads = tbb::info::default_concurrency();
  int runs = 0;
  bool chi2 = false;
  bool residuals = false;
  bool certify = false;
  bool calibrate = false;
  std::string weights;  // FILE, or empty
  std::vector<Id> fixed;
  std::vector<std::string> priors;
  std::string start;
  bool keep = false;
};

void add_options(cmd::Command& command, Options& options) {
  cmd::add_inputs(command, options.inputs);
  options.inputs.options.unknown_edge = factor::has_no_model;
  auto& app = command.app;
  app.add_flag("--gn", options.gauss_newton, "Gauss-Newton instead of Levenberg-Marquardt");
  app.add_option("-i,--iterations", options.iterations,
                 "At most N, and write what they reach (default: 1000)")
      ->option_text("N")
      ->transform(cmd::whole(0));
  app.add_option("--tolerance", options.tolerance,
                 "Least relative change of chi-square (default: 1e-9)")
      ->option_text("X")
      ->check(cmd::number(0));
  solving::add_robust(app, options.robust);
  app.add_option("--weights", options.weights, "Write a table, too: what every edge counted")
      ->option_text("FILE");
  app.add_option("--fix", options.fixed, "Take these vertices for constants")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->transform(cmd::whole(0, std::numeric_limits<Id>::max()))
      ->option_text("ID,...");
  app.add_option("--prior", options.priors, "Measure vertex ID: numbers, standard deviations")
      ->allow_extra_args(false)
      ->option_text("ID:X,...:S,...");
  cmd::add_methods(command, options.method);
  cmd::add_best(command, options.method.best);
  app.add_option("--backend", options.backend, "Eliminate by " + solve::backend_names())
      ->check(cmd::suggests(text::names_of(solve::backends())))
      ->option_text("NAME");
  app.add_option("-j,--threads", options.threads, "Use N threads (default: all cores)")
      ->option_text("N")
      ->transform(cmd::whole(1, 4096));
  app.add_option("--start", options.start, "Start from " + solve::start_names())
      ->option_text("NAME");
  app.add_flag_callback(
      "--init", [&options] { options.start = "odometry"; }, "The same as --start odometry");
  app.add_flag("--keep", options.keep, "Write the graph even if it did not converge");
  app.add_flag("--chi2", options.chi2, "Print the chi-square of the graph as it is");
  app.add_flag("--residuals", options.residuals, "Print a table: a row an edge, the worst first");
  app.add_flag("--certify", options.certify, "Print a table: whether this is the global optimum");
  app.add_option("--time", options.runs, "Print a table: the median time of N eliminations")
      ->option_text("N")
      ->transform(cmd::whole(1));
  app.add_flag("--calibrate", options.calibrate,
               "Time eliminations, so that sg-ec foretells seconds");
  cmd::add_filter_output(command, options.output);
  cmd::add_table(command, options.table,
                 {{"", cmd::headings(solving::time_columns)},
                  {"With --residuals and --weights:", cmd::headings(solving::residual_columns)},
                  {"With --certify:", cmd::headings(solving::certificate_columns)}});
}

solve::BatchOptions batch_options(const Options& options, const Graph& graph) {
  solve::BatchOptions batch;
  batch.method = options.gauss_newton ? solve::BatchMethod::gauss_newton
                                      : solve::BatchMethod::levenberg_marquardt;
  batch.iterations = options.iterations.value_or(solving::most_iterations);
  batch.tolerance = options.tolerance;
  batch.loss = solving::loss(options.robust, graph);
  return batch;
}

// The number alone; of several files, each after the file's name.
void print_chi2(const Options& options, const factor::Problem& problem,
                const factor::Values& values, const factor::Loss& loss, cmd::Output& output) {
  const double chi2 = factor::finite_chi2(problem, values, loss);
  if (options.inputs.paths.size() > 1) output.write(problem.graph->file + "\t");
  output.write(text::format_number(chi2) + "\n");
}

void print_iteration(const solve::Iteration& iteration) {
  std::string line = std::to_string(iteration.number);
  for (const double number : {iteration.chi2, iteration.lambda, iteration.step})
    line += '\t' + text::format_number(number);
  line += iteration.kept ? "\tyes" : "\tno";
  for (const double seconds : {iteration.linearize_s, iteration.eliminate_s})
    line += '\t' + text::format_number(seconds);
  cmd::print_error(line + "\n");
}

// How it went, in a line.
void tell(const cmd::Command& command, const solve::BatchResult& result, double seconds) {
  if (command.quiet || !(command.verbose || ::isatty(STDERR_FILENO) != 0)) return;
  cmd::say((result.converged ? "converged after " : "not converged after ") +
           std::to_string(result.iterations) +
           (result.iterations == 1 ? " iteration, " : " iterations, ") + cmd::rounded(seconds, 6) +
           " s: chi-square from " + cmd::rounded(result.initial_chi2, 6) + " to " +
           cmd::rounded(result.chi2, 6) + (result.by_qr ? ", by QR" : ""));
}

// Without an -i of the user's, iterations that do not converge are an error: what they reach is of no use.
void check_converged(const cmd::Command& command, const Options& options,
                     const solve::BatchResult& result) {
  if (result.converged) return;
  const std::string cause = "not converged after " + std::to_string(result.iterations) +
                            " iterations, chi-square " + text::format_number(result.chi2);
  if (result.stopped) return cmd::warn(command, "interrupted: " + cause);
  if (options.iterations || options.keep) return cmd::warn(command, cause);
  throw text::computation_error(cause + ", from " + text::format_number(result.initial_chi2) +
                                "; nothing is written (--keep would): try " +
                                (options.gauss_newton ? "it without --gn, " : "--gn, ") +
                                (options.start.empty() ? "--start isam2" : "it without --start") +
                                ", --kernel cauchy:1, or more iterations (-i N)");
}

// What every edge counts at the estimates, as a table.
void print_residuals(const Options& options, const std::string& path,
                     const factor::Problem& problem, const factor::Values& values,
                     const factor::Loss& loss) {
  cmd::Output output(path);
  cmd::Table table(options.table, solving::residual_columns, {}, output);
  solving::print_residuals(problem, values, loss, table);
  output.commit();
}

void print_certificate(const cmd::Command& command, const Options& options,
                       const factor::Problem& problem, const factor::Values& values) {
  cmd::Output output(options.output.path);
  cmd::Table table(options.table, solving::certificate_columns, {}, output);
  cmd::stage("certify");
  const solve::Certificate certificate = solve::certify(problem, values);
  table.row(certificate);
  solving::warn_of_model(command, certificate);
  output.commit();
}

void warn_of_scale(const cmd::Command& command) {
  cmd::warn(command,
            "nothing fixes the scale: it stays near the start's (FIX a second pose, or add an edge "
            "that measures a length)");
}

// What the user says, or the graph's own.
std::string_view start_name(const Options& options, const Graph& graph) {
  return options.start.empty() ? solve::own_start(graph) : std::string_view(options.start);
}

// Where the user says, or the best of several.
std::vector<solve::Candidate> candidates(const Options& options, const factor::Problem& problem) {
  const factor::Loss loss = solving::loss(options.robust, *problem.graph);
  if (options.start.empty() && !options.robust.gnc) return solve::default_candidates(problem, loss);
  // False edges tell nothing of a start, so that --gnc's is not chosen by chi-square.
  std::vector<solve::Candidate> one;
  one.push_back(solve::make_candidate(problem, start_name(options, *problem.graph), loss));
  return one;
}

// On -v: all starts there are.
void tell_starts(const std::vector<solve::Candidate>& starts) {
  std::string line = "starts by chi-square:";
  for (const solve::Candidate& start : starts)
    line += (&start == &starts[0] ? " " : ", ") + std::string(start.name) + ' ' +
            cmd::rounded(start.chi2, 6);
  cmd::say(line);
}

// own: bytes of the graph's own text, without what --prior adds.
void solve(const cmd::Command& command, const Options& options, const factor::Problem& problem,
           Offset own) {
  const auto begin = std::chrono::steady_clock::now();
  cmd::stage("start");
  std::vector<solve::Candidate> starts = candidates(options, problem);
  if (command.verbose) tell_starts(starts);
  const Graph& graph = *problem.graph;
  const auto plan = [&](const factor::Problem& part, const factor::LinearSystem& system) {
    return solving::planned({options.method, options.backend, options.threads}, part, system);
  };
  cmd::stage("order");
  factor::LinearSystem system;
  solve::LinearSolver solver;
  if (!options.robust.gnc) {
    system = factor::make_linear_system(problem);
    solver = plan(problem, system);
  }
  solve::BatchOptions batch = batch_options(options, graph);
  batch.stop = cmd::interrupted;
  cmd::finish_first();
  cmd::stage("solve", batch.iterations);
  const auto tell_start = [&](std::string_view start, double chi2, int iterations) {
    if (!command.verbose) return;
    cmd::say((iterations > 0 ? "on from " : "from ") + std::string(start) + ":");
    cmd::print_error("iteration\tchi2\tlambda\tstep\tkept\tlinearize_s\teliminate_s\n");
    print_iteration({iterations, chi2, 0, 0, true, 0, 0});
  };
  const auto report = [&](const solve::Iteration& iteration) {
    cmd::progress(iteration.number);
    if (command.verbose) print_iteration(iteration);
  };
  factor::Values values;
  solve::GncResult found;
  if (options.robust.gnc) {
    tell_start(starts.front().name, starts.front().chi2, 0);
    values = std::move(starts.front().values);
    found = solve::graduate(problem, plan, solving::gnc_options(options.robust, problem, batch),
                            values, report);
  } else {
    const bool others = options.start.empty() && !options.iterations;
    found.batch = solve::optimize_from_best(problem, system, solver, batch, std::move(starts),
                                            others, values, tell_start, report);
  }
  const auto& [result, weight] = found;
  check_converged(command, options, result);
  if (result.scale_free) warn_of_scale(command);
  if (!options.weights.empty()) {
    batch.loss.share = weight;
    print_residuals(options, options.weights, problem, values, batch.loss);
  }
  formats::Changes changes = cmd::estimate_changes(problem, values, solving::moved(problem));
  solving::leave_out_priors(graph, own, changes);
  cmd::write_filtered(command, options.output, graph, std::move(changes));
  tell(command, result, cmd::seconds_since(begin));
}

void calibrate(const cmd::Command& command) {
  const std::string path = cmd::make_calibration_path();
  const std::vector<solve::Sample> samples = solving::timed_samples();
  const solve::Times times = solve::fit_times(samples);
  const auto [r2, worst] = solving::fit_of(samples, times);
  cmd::write_calibration(path, times);
  if (command.quiet) return;
  cmd::say(std::to_string(samples.size()) + " eliminations: R^2 " + cmd::rounded(r2, 4) +
           ", at worst off by " + cmd::rounded(worst, 3) + " times; kept in " + path);
}

void check_files(const Options& options) {
  if (options.weights.empty()) return;
  if (cmd::same_file(options.weights, options.output.path))
    throw text::usage_error("--weights and -o are one file, '" + options.weights +
                            "': the table and the graph need each its own");
  cmd::check_output(options.weights);
}

void check_call(const cmd::Command& command, const Options& options) {
  const CLI::App& app = command.app;
  cmd::check_form(app);
  solving::check_robust(app, options.robust);
  cmd::at_most_one(app, {{"--chi2", "prints the chi-square"},
                         {"--residuals", "prints that of every edge"},
                         {"--certify", "tells whether it is the least"},
                         {"--time", "times eliminations"},
                         {"--calibrate", "times those of graphs of its own"}});
  const std::initializer_list<const char*> optimizing{
      "--gn", "-i", "--tolerance", "--keep", "--no-trace-comment", "--gnc", "--weights"};
  const std::initializer_list<const char*> eliminating{"-m",         "--seed",    "--budget",
                                                       "--minimize", "--backend", "-j"};
  for (const std::string job : {"--chi2", "--residuals", "--certify", "--time", "--calibrate"}) {
    if (cmd::given(app, job))
      cmd::refuse(app, optimizing, "with " + job + ", which does not optimize");
  }
  for (const std::string job : {"--chi2", "--residuals"}) {
    if (cmd::given(app, job))
      cmd::refuse(app, eliminating, "with " + job + ", which eliminates nothing");
  }
  if (options.certify)
    cmd::refuse(app, {"-m", "--seed", "--budget", "--minimize", "--backend", "-j", "--kernel"},
                "with --certify");
  if (options.calibrate)
    cmd::refuse(app,
                {"FILE", "-m", "--seed", "--budget", "--minimize", "--backend", "-j", "--start",
                 "--init", "--fix", "--kernel", "--kernel-on", "-o"},
                "with --calibrate, which has graphs of its own");
  if (options.runs == 0 && !options.residuals && !options.certify && options.weights.empty())
    cmd::refuse_table(app, "without --time, --residuals, --weights or --certify");
  if (options.runs == 0 && options.method.names.size() > 1)
    throw text::usage_error("-m: one ordering to optimize by; several are compared by --time");
  if (!options.chi2 && options.runs == 0 && options.inputs.paths.size() > 1)
    throw text::usage_error(
        "one graph to optimize, since one comes out; several files are for --time and --chi2");
  check_files(options);
}

void run(const cmd::Command& command, const Options& options) {
  check_call(command, options);  // a wrong call is told before a long read
  solve::find_backend(options.backend);
  cmd::check(options.method);
  cmd::check_best(command, cmd::asks_for_best(options.method), options.method.best);
  solve::kernels();
  if (options.calibrate) return calibrate(command);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, options.threads);

  std::optional<cmd::Output> output;
  std::optional<cmd::Table<solving::Timing>> times;
  if (options.chi2 || options.runs > 0) output.emplace(options.output.path);
  if (options.runs > 0) {
    const cmd::Given given{{"several files", options.inputs.paths.size() > 1}};
    times.emplace(options.table, solving::time_columns, given, *output);
  }
  for (const std::string& path : options.inputs.paths) {
    Graph graph = cmd::read(options.inputs, path);
    const auto own = static_cast<Offset>(graph.text.view.size());
    if (!options.priors.empty())
      graph = solving::with_priors(graph, options.priors, options.inputs.options);
    for (const Id id : options.fixed) graph.fixed[cmd::vertex_of(graph, "--fix", id)] = true;
    cmd::stage("start");
    const factor::Problem problem = factor::make_problem(graph);
    const bool looks = options.chi2 || options.residuals || options.certify || times;
    if (!looks) {
      solve(command, options, problem, own);
      continue;
    }
    const factor::Loss loss = solving::loss(options.robust, graph);
    const factor::Values values = solve::find_start(start_name(options, graph)).make(problem);
    if (options.chi2) {
      print_chi2(options, problem, values, loss, *output);
    } else if (options.residuals) {
      print_residuals(options, options.output.path, problem, values, loss);
    } else if (options.certify) {
      print_certificate(command, options, problem, values);
    } else {
      solving::print_times({options.runs, options.threads, options.backend, options.method, loss},
                           problem, values, *times);
    }
  }
  if (output) output->commit();
}

}  // namespace

int main(int argc, char** argv) {
  return cmd::run(cmd::Command("sg-solve", "Optimize a graph; time its elimination."), argc, argv,
                  add_options, run);
}
