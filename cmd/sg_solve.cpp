// sg-solve: optimize a graph in batch; or time its elimination, or tell its chi-square.
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>

#include "cmd/common/command.h"
#include "cmd/common/estimates.h"
#include "cmd/common/method.h"
#include "cmd/common/options.h"
#include "cmd/common/table.h"
#include "lib/elim/score.h"
#include "lib/factor/initialize.h"
#include "lib/solve/batch.h"
#include "lib/solve/best_start.h"
#include "lib/solve/front.h"
#include "lib/solve/start.h"
#include "lib/text/words.h"

using namespace sg;

namespace {

// How long elimination takes, as --time measures it.
struct Timing {
  std::string order;
  std::string backend;
  int threads;
  Index variables;
  Index factors;
  elim::Wide ec;
  int runs;
  double plan_s;
  double median_s;
};

const std::vector<cmd::Column<Timing>> time_columns{
    {"order", "The ordering", &Timing::order},
    {"backend", "What eliminates", &Timing::backend},
    {"threads", "How many it may use", &Timing::threads},
    {"variables", "How many are eliminated", &Timing::variables},
    {"factors", "Edges of the graph", &Timing::factors},
    {"ec", "Elimination complexity", &Timing::ec},
    {"runs", "Eliminations that were timed", &Timing::runs},
    {"plan_s", "Seconds once spent on the structure", &Timing::plan_s},
    {"median_s", "Median of the elimination times, in seconds", &Timing::median_s},
    {"s_per_ec", "The same for a unit of elimination complexity",
     [](Timing& timing) { return timing.median_s / elim::to_double(timing.ec); }},
};

struct Options {
  cmd::Input input;
  cmd::OutputOptions output;
  cmd::TableOptions table;
  bool gauss_newton = false;
  std::optional<int> iterations;  // as many, whether that is enough or not
  double tolerance = 1e-9;
  std::string kernel;
  cmd::MethodOptions method;
  std::string backend{solve::backends().front().name};
  int threads = tbb::info::default_concurrency();
  int runs = 0;
  bool chi2 = false;
  std::string start;
  bool keep = false;
};

constexpr int most_iterations = 1000;

void add_options(cmd::Command& command, Options& options) {
  cmd::add_input(command, options.input);
  options.input.options.unknown_edge = factor::has_no_model;
  auto& app = command.app;
  app.add_flag("--gn", options.gauss_newton, "Gauss-Newton instead of Levenberg-Marquardt");
  app.add_option(
         "-i,--iterations", options.iterations,
         "At most N iterations, and write what they reach\n(default: 1000, which have to converge)")
      ->option_text("N")
      ->transform(cmd::whole(0));
  app.add_option("--tolerance", options.tolerance,
                 "Least relative change of chi-square (default: 1e-9)")
      ->option_text("X")
      ->check(cmd::number(0));
  app.add_option("--kernel", options.kernel, "Robust kernel huber or cauchy, of width W")
      ->option_text("NAME:W");
  cmd::add_methods(command, options.method);
  app.add_option("--backend", options.backend, "Eliminate by " + solve::backend_names())
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
  app.add_option("--time", options.runs, "Print a table: the median time of N eliminations")
      ->option_text("N")
      ->transform(cmd::whole(1));
  cmd::add_filter_output(command, options.output);
  cmd::add_table(command, options.table, time_columns);
}

factor::Kernel parse_kernel(const std::string& text) {
  if (text.empty()) return {};
  const auto colon = text.find(':');
  const std::string name = text.substr(0, colon);
  const auto width =
      text::parse<double>(colon == text.npos ? "" : std::string_view(text).substr(colon + 1));
  if (width && *width > 0) {
    if (name == "huber") return {factor::KernelShape::huber, *width};
    if (name == "cauchy") return {factor::KernelShape::cauchy, *width};
  }
  throw text::usage_error("--kernel wants huber:W or cauchy:W with W above 0, not '" + text + "'");
}

solve::BatchOptions batch_options(const Options& options) {
  solve::BatchOptions batch;
  batch.method = options.gauss_newton ? solve::BatchMethod::gauss_newton
                                      : solve::BatchMethod::levenberg_marquardt;
  batch.iterations = options.iterations.value_or(most_iterations);
  batch.tolerance = options.tolerance;
  batch.kernel = parse_kernel(options.kernel);
  return batch;
}

cmd::NamedOrder named_order(const Options& options, const Graph& graph) {
  return cmd::named_order(options.method, graph,
                          graph::graph_pattern(graph));  // without the gauge's row
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> times) {
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

Timing timed(const Options& options, const factor::Problem& problem, const factor::Values& values,
             factor::LinearSystem& system, const std::string& label, const graph::Order& order) {
  const graph::Pattern& pattern = problem.variables.pattern;
  const auto start = std::chrono::steady_clock::now();
  const auto solver = solve::find_backend(options.backend).make(system, order, options.threads);
  const double plan = seconds_since(start);
  std::vector<double> times;
  for (int k = 0; k < options.runs && (k == 0 || !cmd::interrupted()); ++k) {
    cmd::progress(k);
    const auto begin = std::chrono::steady_clock::now();
    if (!solver.eliminate(system, {})) throw solve::singular_error(problem, values, system);
    times.push_back(seconds_since(begin));
  }
  return {label,
          options.backend,
          options.threads,
          pattern.variables(),
          problem.graph->edges(),
          elim::elimination_complexity(pattern, order),
          static_cast<int>(times.size()),
          plan,
          median(times)};
}

void print_times(const Options& options, const factor::Problem& problem,
                 const factor::Values& values) {
  cmd::Output output(options.output.path);
  cmd::Table table(options.table, time_columns, {}, output);
  factor::LinearSystem system = factor::make_linear_system(problem);
  factor::linearize(problem, values, parse_kernel(options.kernel), system);
  const graph::GraphPattern variables =
      graph::graph_pattern(*problem.graph);  // without the gauge's row
  cmd::finish_first();
  for (const cmd::Method& method : cmd::methods(options.method, *problem.graph)) {
    cmd::stage("order");
    const graph::Order order = cmd::order_by(method, options.method, *problem.graph, variables);
    cmd::stage("eliminate", options.runs);
    table.row(timed(options, problem, values, system, method.label, order));
  }
  output.commit();
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

// Which vertices' lines an optimization rewrites: all but the constants.
std::vector<bool> moved(const factor::Problem& problem) {
  std::vector<bool> result(problem.graph->vertices(), false);
  for (std::size_t j = 0; j < problem.variables.variable_vertex.size(); ++j) {
    result[problem.variables.variable_vertex[j]] = !factor::is_held(problem, static_cast<Index>(j));
  }
  return result;
}

std::string rounded(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", number);
  return text;
}

// How it went, in a line.
void tell(const cmd::Command& command, const solve::BatchResult& result, double seconds) {
  if (command.quiet || !(command.verbose || ::isatty(STDERR_FILENO) != 0)) return;
  cmd::say((result.converged ? "converged after " : "not converged after ") +
           std::to_string(result.iterations) +
           (result.iterations == 1 ? " iteration, " : " iterations, ") + rounded(seconds) +
           " s: chi-square from " + rounded(result.initial_chi2) + " to " + rounded(result.chi2) +
           (result.by_qr ? ", by QR" : ""));
}

// Without an -i of the user's, iterations that do not converge are an error: what they reach is of no use.
void check_converged(const cmd::Command& command, const Options& options,
                     const solve::BatchResult& result) {
  if (result.converged) return;
  const std::string cause = "not converged after " + std::to_string(result.iterations) +
                            " iterations, chi-square " + text::format_number(result.chi2);
  if (result.stopped) return cmd::warn(command, "interrupted: " + cause);
  if (options.iterations || options.keep) return cmd::warn(command, cause);
  throw text::computation_error(
      cause + ", from " + text::format_number(result.initial_chi2) +
      "; nothing is written (--keep would): try " +
      (options.gauss_newton ? "it without --gn, " : "--gn, ") +
      (options.start.empty() ? "--start isam2" : "it without --start") +
      ", --kernel cauchy:1, or more iterations (-i N)");
}

// Where the user says, or the best of several.
std::vector<solve::Candidate> candidates(const Options& options, const factor::Problem& problem) {
  const factor::Kernel kernel = parse_kernel(options.kernel);
  if (options.start.empty()) return solve::default_candidates(problem, kernel);
  std::vector<solve::Candidate> one;
  one.push_back(solve::make_candidate(problem, options.start, kernel));
  return one;
}

// On -v: all starts there are.
void tell_starts(const std::vector<solve::Candidate>& starts) {
  std::string line = "starts by chi-square:";
  for (const solve::Candidate& start : starts)
    line +=
        (&start == &starts[0] ? " " : ", ") + std::string(start.name) + ' ' + rounded(start.chi2);
  cmd::say(line);
}

void solve(const cmd::Command& command, const Options& options, const factor::Problem& problem) {
  const auto begin = std::chrono::steady_clock::now();
  cmd::stage("start");
  std::vector<solve::Candidate> starts = candidates(options, problem);
  if (command.verbose) tell_starts(starts);
  cmd::stage("order");
  const graph::Order order = named_order(options, *problem.graph).order;
  factor::LinearSystem system = factor::make_linear_system(problem);
  const auto solver = solve::find_backend(options.backend).make(system, order, options.threads);
  solve::BatchOptions batch = batch_options(options);
  batch.stop = cmd::interrupted;
  cmd::finish_first();
  cmd::stage("solve", batch.iterations);
  const auto tell_start = [&](const solve::Candidate& start) {
    if (!command.verbose) return;
    cmd::say("from " + std::string(start.name) + ":");
    cmd::print_error("iteration\tchi2\tlambda\tstep\tkept\tlinearize_s\teliminate_s\n");
    print_iteration({0, start.chi2, 0, 0, true, 0, 0});
  };
  const auto report = [&](const solve::Iteration& iteration) {
    cmd::progress(iteration.number);
    if (command.verbose) print_iteration(iteration);
  };
  factor::Values values;
  const bool others = options.start.empty() && !options.iterations;
  const solve::BatchResult result = solve::optimize_from_best(
      problem, system, solver, batch, std::move(starts), others, values, tell_start, report);
  check_converged(command, options, result);
  if (result.scale_free) {
    cmd::warn(
        command,
        "nothing fixes the scale: it stays near the start's (FIX a second pose, or add an edge "
        "that measures a length)");
  }
  cmd::write_filtered(command, options.output, *problem.graph,
                      cmd::estimate_changes(problem, values, moved(problem)));
  tell(command, result, seconds_since(begin));
}

// Of what is not optimized.
factor::Values start_values(const Options& options, const factor::Problem& problem) {
  return options.start.empty() ? factor::start_values(problem)
                               : solve::find_start(options.start).make(problem);
}

void check_call(const cmd::Command& command, const Options& options) {
  const CLI::App& app = command.app;
  cmd::check_form(app);
  cmd::at_most_one(app, {{"--chi2", "prints the chi-square"}, {"--time", "times eliminations"}});
  const std::initializer_list<const char*> optimizing{"--gn", "-i", "--tolerance", "--keep",
                                                      "--no-trace-comment"};
  if (options.chi2) cmd::refuse(app, optimizing, "with --chi2, which does not optimize");
  if (options.runs > 0) cmd::refuse(app, optimizing, "with --time, which does not optimize");
  if (options.chi2)
    cmd::refuse(app, {"-m", "--seed", "--backend", "-j"}, "with --chi2, which eliminates nothing");
  if (options.runs == 0) cmd::refuse_table(app, "without --time");
  if (options.runs == 0 && options.method.names.size() > 1)
    throw text::usage_error("-m: one ordering to optimize by; several are compared by --time");
}

void run(const cmd::Command& command, const Options& options) {
  parse_kernel(options.kernel);  // a wrong call is told before a long read
  check_call(command, options);
  solve::find_backend(options.backend);
  cmd::check(options.method);
  solve::kernels();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, options.threads);

  const Graph graph = cmd::read(options.input);
  cmd::stage("start");
  const factor::Problem problem = factor::make_problem(graph);
  if (options.chi2) {
    const factor::Values values = start_values(options, problem);
    cmd::Output output(options.output.path);
    output.write(
        text::format_number(factor::finite_chi2(problem, values, parse_kernel(options.kernel))) +
        "\n");
    output.commit();
  } else if (options.runs > 0) {
    print_times(options, problem, start_values(options, problem));
  } else {
    solve(command, options, problem);
  }
}

}  // namespace

int main(int argc, char** argv) {
  return cmd::run(cmd::Command("sg-solve", "Optimize a graph; time its elimination."), argc, argv,
                  add_options, run);
}
