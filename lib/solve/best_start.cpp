#include "lib/solve/best_start.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lib/factor/motion.h"
#include "lib/solve/start.h"

namespace sg::solve {
namespace {

constexpr int long_run = 100;  // iterations after which the others are asked
constexpr int trial_run = 20;  // that each of them has to get below the best
constexpr int patience = 5;    // of these, that it has to get within reach of it
constexpr double reach = 1000;

constexpr double deviations = 4;
constexpr double gain = 1e-6;  // less is the same valley

// What chi-square is on average if all errors are noise as their information says.
double degrees_of_freedom(const factor::Problem& problem) {
  double sum = 0;
  for (Index e = 0; e < problem.graph->edges(); ++e) {
    if (!problem.variables.pattern.rows[e].empty()) sum += problem.model[e]->dim;
  }
  if (problem.held >= 0) sum += factor::held_dim(problem);
  return sum - problem.step_at.back();
}

bool measures_motions(const factor::Problem& problem) {
  for (Index e = 0; e < problem.graph->edges(); ++e) {
    if (problem.graph->edge(e).size() > 1 && factor::measured_motion(problem, e)) return true;
  }
  return false;
}

// A way to an end: how far it is.
struct Run {
  factor::Values values;
  BatchResult result;
};

struct Search {
  const factor::Problem& problem;
  factor::LinearSystem& system;
  const LinearSolver& solver;
  const BatchOptions& options;
  const TellStart& tell_start;
  const std::function<void(const Iteration&)>& report;
  std::optional<Run> best{};
  std::optional<text::Error> error{};  // of the first start
};

// At most so many iterations more, and few where chi-square stays above this.
void go_on(Search& search, Run& run, int iterations,
           double out_of_reach = std::numeric_limits<double>::infinity()) {
  BatchOptions options = search.options;
  options.iterations = iterations;
  const int before = run.result.iterations;
  bool given_up = false;
  const auto report = [&](Iteration iteration) {
    given_up = iteration.number >= patience && iteration.chi2 > out_of_reach;
    iteration.number += before;
    if (search.report) search.report(iteration);
  };
  options.stop = [&] { return given_up || (search.options.stop && search.options.stop()); };
  const double initial = run.result.initial_chi2;
  run.result = optimize(search.problem, search.system, search.solver, options, run.values, report);
  run.result.iterations += before;
  run.result.initial_chi2 = initial;
  if (given_up) run.result.stopped = false;
}

bool is_left(const Search& search, const Run& run) {
  return !run.result.converged && !run.result.stopped &&
         run.result.iterations < search.options.iterations;
}

void go_to_the_end(Search& search, Run& run) {
  if (is_left(search, run)) go_on(search, run, search.options.iterations - run.result.iterations);
}

// Nothing where it diverges.
std::optional<Run> set_out(Search& search, Candidate& start, int iterations,
                           double out_of_reach = std::numeric_limits<double>::infinity()) {
  if (search.tell_start) search.tell_start(start);
  Run run{std::move(start.values), {start.chi2, start.chi2, 0, false}};
  try {
    go_on(search, run, std::min(iterations, search.options.iterations), out_of_reach);
    return run;
  } catch (const text::Error& error) {
    if (!search.error) search.error = error;
    return {};
  }
}

bool noise_explains(const factor::Problem& problem, double chi2) {
  const double mean = std::max(degrees_of_freedom(problem), 0.0);
  return chi2 <= mean + deviations * std::sqrt(2 * mean);
}

bool explains(const factor::Problem& problem, const std::optional<Run>& run) {
  return run && run->result.converged && noise_explains(problem, run->result.chi2);
}

void try_other(Search& search, Candidate& start) {
  const double best =
      search.best ? search.best->result.chi2 : std::numeric_limits<double>::infinity();
  std::optional<Run> run = set_out(search, start, trial_run, reach * best);
  if (!run || !(run->result.chi2 < (1 - gain) * best)) return;
  go_to_the_end(search, *run);
  search.best = std::move(run);
}

}  // namespace

Candidate make_candidate(const factor::Problem& problem, std::string_view start,
                         const factor::Loss& loss) {
  const Start& row = find_start(start);
  Candidate result{row.name, row.make(problem), 0};
  result.chi2 = factor::chi2(problem, result.values, loss);
  return result;
}

std::vector<Candidate> default_candidates(const factor::Problem& problem,
                                          const factor::Loss& loss) {
  std::vector<Candidate> result;
  const auto add = [&](std::string_view start) {
    result.push_back(make_candidate(problem, start, loss));
  };
  add(own_start(*problem.graph));
  if (!noise_explains(problem, result[0].chi2) && measures_motions(problem)) add("chordal");
  std::ranges::stable_sort(result, [](const Candidate& a, const Candidate& b) {
    return a.chi2 < b.chi2 || (std::isfinite(a.chi2) && !std::isfinite(b.chi2));
  });
  return result;
}

BatchResult optimize_from_best(const factor::Problem& problem, factor::LinearSystem& system,
                               const LinearSolver& solver, const BatchOptions& options,
                               std::vector<Candidate> candidates, bool others,
                               factor::Values& values, const TellStart& tell_start,
                               const std::function<void(const Iteration&)>& report) {
  Search search{problem, system, solver, options, tell_start, report};
  search.best = set_out(search, candidates[0], others ? long_run : options.iterations);
  if (others && !explains(problem, search.best)) {
    if (measures_motions(problem))
      candidates.push_back(make_candidate(problem, "tree", options.loss));
    for (std::size_t k = 1; k < candidates.size() && !(search.best && search.best->result.stopped);
         ++k)
      try_other(search, candidates[k]);
  }
  if (!search.best) throw text::Error(*search.error);
  go_to_the_end(search, *search.best);
  values = std::move(search.best->values);
  return search.best->result;
}

}  // namespace sg::solve
