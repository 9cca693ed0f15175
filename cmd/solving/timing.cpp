#include "cmd/solving/timing.h"

#include <algorithm>
#include <chrono>

#include "cmd/common/processor.h"
#include "cmd/common/stage.h"
#include "lib/solve/batch.h"
#include "lib/solve/linear_solver.h"

namespace sg::solving {

double median(std::vector<double> times) {
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

Timing timed(const TimingOptions& options, const factor::Problem& problem,
             const factor::Values& values, factor::LinearSystem& system, const std::string& label,
             const graph::Order& order) {
  const graph::Pattern& pattern = problem.variables.pattern;
  const auto start = std::chrono::steady_clock::now();
  const auto solver = solve::find_backend(options.backend).make(system, order, options.threads);
  const double plan = cmd::seconds_since(start);
  // CHOLMOD's BLAS may have threads of its own.
  const bool alone = options.threads == 1 && options.backend == solve::backends().front().name;
  const auto clock = alone ? cmd::thread_seconds : cmd::processor_seconds;
  std::vector<double> times, processor;
  for (int k = 0; k < options.runs && (k == 0 || !cmd::interrupted()); ++k) {
    cmd::progress(k);
    const double before = clock();
    const auto begin = std::chrono::steady_clock::now();
    if (!solver.eliminate(system, {})) throw solve::singular_error(problem, values, system);
    times.push_back(cmd::seconds_since(begin));
    processor.push_back(clock() - before);
  }
  return {problem.graph->file,
          label,
          options.backend,
          options.threads,
          pattern.variables(),
          problem.graph->edges(),
          elim::elimination_complexity(pattern, order),
          static_cast<int>(times.size()),
          plan,
          median(times),
          median(processor)};
}

const std::vector<cmd::Column<Timing>> time_columns{
    {"file", "The file", &Timing::file, "several files"},
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
    {"cpu_s", "Median of their processor seconds, of all threads", &Timing::cpu_s},
};

void print_times(const TimingOptions& options, const factor::Problem& problem,
                 const factor::Values& values, cmd::Table<Timing>& table) {
  factor::LinearSystem system = factor::linearized(problem, values, options.loss);
  const graph::GraphPattern variables =
      graph::graph_pattern(*problem.graph);  // without the gauge's row
  cmd::finish_first();
  for (const cmd::Method& method : cmd::methods(options.methods, *problem.graph)) {
    cmd::stage("order");
    const graph::Order order = cmd::order_by(method, options.methods, *problem.graph, variables);
    cmd::stage("eliminate", options.runs);
    table.row(timed(options, problem, values, system, method.label, order));
  }
}

}  // namespace sg::solving
