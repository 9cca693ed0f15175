#include "cmd/report/variants.h"

#include <algorithm>

#include "cmd/common/estimates.h"
#include "cmd/common/processor.h"
#include "cmd/isam2/timed.h"
#include "cmd/solving/plan.h"
#include "formats/applied.h"
#include "lib/solve/best_start.h"
#include "lib/solve/isam2_replay.h"
#include "lib/text/nearest.h"

namespace sg::report {
namespace {

constexpr double for_the_whole = 0.25;  // of the time, since all others are compared with it

// What the variants of one graph share.
struct Bench {
  Study& study;
  std::vector<cmd::Method> methods;  // of a policy's graph: one or two
  std::optional<scoring::Reference> reference;
  std::string reference_file;  // in calls
  Index min_obs;
  elim::Wide whole_ec = 0;
  bool measurable = true;                                        // the whole graph is
  std::vector<std::pair<std::string, std::string>> failed = {};  // what, and why
};

// As sg-solve has it where a call says nothing else; nothing where the time did not suffice.
std::optional<Graph> solved(const Study& study, Timer& timer, const cmd::Method& method,
                            const Deadline& deadline) {
  const Graph& graph = *timer.problem.graph;
  const cmd::MethodOptions methods{{method.label}, study.methods.seed};
  const std::string backend(solve::backends().front().name);
  factor::LinearSystem system = factor::make_linear_system(timer.problem);
  const solve::LinearSolver solver =
      solving::planned({methods, backend, study.threads}, timer.problem, system);
  solve::BatchOptions options;
  options.iterations = solving::most_iterations;
  options.stop = [&] { return deadline.passed(); };
  factor::Values values;
  const solve::BatchResult result = solve::optimize_from_best(
      timer.problem, system, solver, options,
      solve::default_candidates(timer.problem, options.loss), true, values, {}, {});
  if (result.stopped) return std::nullopt;
  if (!result.converged)
    throw text::computation_error("not converged after " + std::to_string(result.iterations) +
                                  " iterations");
  return formats::applied(
      graph, cmd::estimate_changes(timer.problem, values, solving::moved(timer.problem)),
      study.reading);
}

// Nothing where the time did not suffice.
std::optional<double> isam2_seconds(const Graph& graph, const cmd::Method& method, Index min_obs,
                                    const Deadline& deadline) {
  factor::Problem problem = factor::make_problem(graph);
  isam2::hold_at_first(problem);
  solve::Isam2Options options;
  options.ordering = method.label;
  solve::Isam2Replay replay = solve::make_isam2_replay(problem, options, min_obs, false);
  double seconds = 0;
  for (Index k = 0; k < replay.steps.steps; ++k) {
    if (deadline.passed()) return std::nullopt;
    const double start = cmd::processor_seconds();
    solve::replay_step(replay, k);
    seconds += cmd::processor_seconds() - start;
  }
  return seconds;
}

void score_solved(Bench& bench, const Graph& solved, std::span<Variant> variants) {
  static const std::optional<score::Odometry> none;
  if (!bench.reference) bench.reference = scoring::Reference{solved};
  scoring::Subject subject{
      bench.study.methods, score::Alignment::se, bench.reference, none, solved.file, solved,
      trees::Weights::unit};
  scoring::Row row{subject, bench.methods.front()};
  const std::optional<double> sigma = row.sigma_mean();
  for (Variant& variant : variants) {
    variant.sigma = sigma;
    variant.ate = subject.error().ate;
  }
}

std::string min_obs(const Bench& bench) {
  return bench.min_obs > 1 ? " --min-obs " + std::to_string(bench.min_obs) : "";
}

// What prints the numbers of a variant; `commands` are its policy's.
std::vector<std::string> calls(const Bench& bench, std::vector<std::string> commands,
                               const std::string& method) {
  const auto behind = [&](std::initializer_list<std::string> last) {
    std::vector<std::string> all = commands;
    all.insert(all.end(), last);
    return pipe(bench.study.source, all);
  };
  return {
      behind({"sg-ec -m " + method + " -f ec"}),
      behind({"sg-solve --time " + std::to_string(timed_runs) + " -m " + method + " -f median_s"}),
      behind({"sg-isam2 -m " + method + min_obs(bench) + " -f update_s"}) +
          " | awk '{s += $1} END {print s}'",
      behind({"sg-solve",
              "sg-score --reference " + bench.reference_file + " -f sigma_mean,ate_rmse"})};
}

// Of one policy's graph, a variant an ordering, with its order.
std::vector<Variant> costs(const Bench& bench, const Policy& policy, std::optional<Index> rate,
                           const Graph& graph, std::vector<graph::Order>& orders) {
  const graph::GraphPattern variables = graph::graph_pattern(graph);
  std::vector<Variant> result;
  for (const cmd::Method& method : bench.methods) {
    orders.push_back(cmd::order_by(method, bench.study.methods, graph, variables));
    Variant variant;
    variant.policy = policy.name;
    variant.rate = rate;
    variant.order = method.label;
    variant.vertices = graph.vertices();
    variant.edges = graph.edges();
    variant.ec = elim::elimination_complexity(variables.pattern, orders.back());
    std::vector<std::string> commands = policy.commands(rate.value_or(1));
    for (std::string& command : commands) command += min_obs(bench);
    variant.calls = calls(bench, commands, method.label);
    commands.push_back("sg-order -m " + method.label);
    variant.pipe = pipe(bench.study.source, commands);
    result.push_back(std::move(variant));
  }
  return result;
}

// What is measured of one graph, piece by piece: where one fails, a note tells.
void measure(Bench& bench, const Graph& graph, const std::vector<graph::Order>& orders,
             const Deadline& deadline, const std::string& name, std::span<Variant> variants) {
  Study& study = bench.study;
  if (!bench.measurable) return;
  const std::unique_ptr<Timer> timer = report::timer(graph, study.notes);
  if (!timer) {
    bench.measurable = false;
    return;
  }
  const auto attempt = [&](const char* what, const auto& work) {
    try {
      work();
    } catch (const text::Error& error) {
      bench.failed.emplace_back(name + " (" + what + ")", error.what());
    }
  };
  attempt("elimination", [&] {
    for (std::size_t k = 0; k < variants.size(); ++k)
      variants[k].median_s =
          median_seconds(study, *timer, variants[k].order, orders[k], variants[k].ec, deadline);
  });
  // An iteration takes about one elimination, and a solution several.
  const std::optional<double> elimination = variants.front().median_s;
  if (!elimination || deadline.left() < 10 * *elimination) return;
  attempt("solution", [&] {
    if (const auto optimum = solved(study, *timer, bench.methods.front(), deadline))
      score_solved(bench, *optimum, variants);
  });
  attempt("iSAM2", [&] {
    for (std::size_t k = 0; k < variants.size(); ++k)
      variants[k].isam2_s = isam2_seconds(graph, bench.methods[k], bench.min_obs, deadline);
  });
}

// A note a cause.
void note_failures(Bench& bench) {
  const auto cause = &std::pair<std::string, std::string>::second;
  std::ranges::stable_sort(bench.failed, {}, cause);
  for (auto first = bench.failed.begin(); first != bench.failed.end();) {
    std::vector<std::string> those;
    const std::string why = first->second;
    for (; first != bench.failed.end() && first->second == why; ++first)
      those.push_back(first->first);
    bench.study.notes.push_back(text::listed(those) + ": " + why);
  }
}

const std::vector<cmd::Column<Variant>> columns{
    {"policy", "What is left of the graph", &Variant::policy},
    {"rate", "R of the policy", &Variant::rate},
    {"order", "The ordering", &Variant::order},
    {"vertices", "That are left", &Variant::vertices},
    {"edges", "That are left", &Variant::edges},
    {"ec", "Elimination complexity", &Variant::ec},
    {"of_full", "Share of the EC of the whole graph in the first ordering", &Variant::of_full},
    {"median_s", "Median of the elimination times, in seconds", &Variant::median_s},
    {"isam2_s", "Processor seconds of a replay through iSAM2, all steps", &Variant::isam2_s},
    {"sigma_mean", "Mean standard deviation of a pose's position, solved", &Variant::sigma},
    {"ate_rmse", "Absolute trajectory error, root mean square, solved", &Variant::ate},
};

std::vector<cmd::Method> methods_of_variants(const Study& study,
                                             const std::vector<Ordered>& orderings) {
  std::vector<cmd::Method> named;
  const Ordered* least = nullptr;
  for (const Ordered& one : orderings) {
    if (one.method.label == "file") continue;  // an order of this graph alone
    if (named.empty()) named.push_back(one.method);
    if (!least || one.ec < least->ec) least = &one;
  }
  if (least && least->method.label != named.front().label) named.push_back(least->method);
  if (named.empty()) named = cmd::methods(study.methods, study.graph);
  return named;
}

}  // namespace

std::vector<Variant> variants(Study& study, const Choice& choice,
                              const std::vector<Ordered>& orderings,
                              const std::optional<scoring::Reference>& reference,
                              const std::string& reference_file, const Deadline& deadline) {
  Bench bench{study, methods_of_variants(study, orderings), reference, reference_file,
              choice.min_obs};
  std::vector<std::pair<const Policy*, std::optional<Index>>> cells;
  for (const Policy* policy : choice.policies) {
    if (!policy->rated) cells.emplace_back(policy, std::nullopt);
    for (const Index rate : choice.rates) {
      if (policy->rated) cells.emplace_back(policy, rate);
    }
  }
  std::vector<std::string> untried;
  std::vector<Variant> result;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const auto& [policy, rate] = cells[k];
    const std::string name =
        std::string(policy->name) + (rate ? " " + std::to_string(*rate) : std::string());
    cmd::stage("measure", static_cast<std::int64_t>(cells.size()));
    cmd::progress(static_cast<std::int64_t>(k));
    cmd::note(name);
    const Deadline share =
        part(deadline, k == 0 ? for_the_whole : 1 / static_cast<double>(cells.size() - k));
    if (k > 0 && share.passed()) {
      untried.push_back(name);
      continue;
    }
    const std::size_t first = result.size();
    try {
      const auto graph = policy->prune(
          study.graph,
          {study.reading, rate.value_or(1), choice.min_obs, [&] { return !share.passed(); }});
      if (!graph) {
        untried.push_back(name);
        continue;
      }
      std::vector<graph::Order> orders;
      std::vector<Variant> those = costs(bench, *policy, rate, *graph, orders);
      if (k == 0) bench.whole_ec = those.front().ec;
      for (Variant& variant : those) {
        if (bench.whole_ec > 0)
          variant.of_full = elim::to_double(variant.ec) / elim::to_double(bench.whole_ec);
        result.push_back(std::move(variant));
      }
      measure(bench, *graph, orders, share, name, std::span(result).subspan(first));
    } catch (const text::Error& error) {
      bench.failed.emplace_back(name, error.what());
    }
  }
  note_failures(bench);
  if (!untried.empty()) study.notes.push_back("no time (--budget) for " + text::listed(untried));
  return result;
}

Sheet sheet(const std::vector<Variant>& variants) {
  Sheet result;
  result.columns = cmd::headings(columns);
  for (Variant variant : variants) result.rows.push_back(cells(columns, variant));
  return result;
}

}  // namespace sg::report
