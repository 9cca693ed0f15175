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
constexpr int slow_steps = 3;  // or so many in a row that gain less than this part of chi-square
constexpr double slow_gain = 1e-4;
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
  std::string_view start;
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

// Whether a run is to be left for now, after this iteration of it.
using Leave = std::function<bool(const Iteration&)>;

// At most so many iterations more.
void go_on(Search& search, Run& run, int iterations, const Leave& leave = {}) {
  BatchOptions options = search.options;
  options.iterations = iterations;
  const int before = run.result.iterations;
  bool left = false;
  const auto report = [&](Iteration iteration) {
    left = leave && leave(iteration);
    iteration.number += before;
    if (search.report) search.report(iteration);
  };
  options.stop = [&] { return left || (search.options.stop && search.options.stop()); };
  const double initial = run.result.initial_chi2;
  run.result = optimize(search.problem, search.system, search.solver, options, run.values, report);
  run.result.iterations += before;
  run.result.initial_chi2 = initial;
  if (left) run.result.stopped = false;
}

bool is_left(const Search& search, const Run& run) {
  return !run.result.converged && !run.result.stopped &&
         run.result.iterations < search.options.iterations;
}

void tell(const Search& search, const Run& run) {
  if (search.tell_start) search.tell_start(run.start, run.result.chi2, run.result.iterations);
}

// Whether it can: an iteration that begins anew wants a regular system, which one on the way need not have.
bool go_to_the_end(Search& search, Run& run) {
  if (!is_left(search, run)) return true;
  tell(search, run);
  try {
    go_on(search, run, search.options.iterations - run.result.iterations);
    return true;
  } catch (const text::Error&) {
    return false;
  }
}

// Nothing where it diverges.
std::optional<Run> set_out(Search& search, Candidate& start, int iterations,
                           const Leave& leave = {}) {
  Run run{start.name, std::move(start.values), {start.chi2, start.chi2, 0, false}};
  tell(search, run);
  try {
    go_on(search, run, std::min(iterations, search.options.iterations), leave);
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

// Once it creeps towards an end that noise does not explain.
Leave if_slow(const factor::Problem& problem, double chi2) {
  return [&problem, last = chi2, slow = 0](const Iteration& iteration) mutable {
    const double gained = std::exchange(last, iteration.chi2) - iteration.chi2;
    const bool is_slow = iteration.kept && gained >= 0 && gained < slow_gain * iteration.chi2;
    slow = is_slow ? slow + 1 : 0;
    return slow >= slow_steps && !noise_explains(problem, iteration.chi2);
  };
}

void try_other(Search& search, Candidate& start) {
  const double best =
      search.best ? search.best->result.chi2 : std::numeric_limits<double>::infinity();
  const auto is_far = [&](const Iteration& iteration) {
    return iteration.number >= patience && iteration.chi2 > reach * best;
  };
  std::optional<Run> run = set_out(search, start, trial_run, is_far);
  if (!run || !(run->result.chi2 < (1 - gain) * best)) return;
  if (go_to_the_end(search, *run)) search.best = std::move(run);
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
  search.best = others
                    ? set_out(search, candidates[0], long_run, if_slow(problem, candidates[0].chi2))
                    : set_out(search, candidates[0], options.iterations);
  if (others && !explains(problem, search.best)) {
    if (measures_motions(problem))
      candidates.push_back(make_candidate(problem, "tree", options.loss));
    for (std::size_t k = 1; k < candidates.size() && !(search.best && search.best->result.stopped);
         ++k)
      try_other(search, candidates[k]);
  }
  if (!search.best) throw text::Error(*search.error);
  if (!go_to_the_end(search, *search.best)) {  // then without leaving it on the way
    Candidate again = make_candidate(problem, search.best->start, options.loss);
    search.best = set_out(search, again, options.iterations);
    if (!search.best) throw text::Error(*search.error);
  }
  values = std::move(search.best->values);
  return search.best->result;
}

}  // namespace sg::solve
