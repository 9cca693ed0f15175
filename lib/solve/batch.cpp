#include "lib/solve/batch.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "lib/factor/gauge.h"
#include "lib/solve/normal_equations.h"
#include "lib/solve/undetermined.h"
#include "lib/text/words.h"

namespace sg::solve {
namespace {

constexpr double first_lambda = 1e-4;
constexpr double least_lambda = 1e-20;
constexpr double largest_lambda = 1e12;
constexpr int patience = 7;  // steps that may go by before an undamped one is the best so far
// Of what is ill-conditioned: more damps away what little holds it.
constexpr double first_lambda_by_qr = 1e-14;

constexpr double flat = 1e-14;  // cosine of the angle between a column of A and what is left of b
constexpr double rounding = std::numeric_limits<double>::epsilon();

double norm(const std::vector<double>& v) {
  return std::sqrt(std::inner_product(v.begin(), v.end(), v.begin(), 0.0));
}

struct Stopwatch {
  std::chrono::steady_clock::time_point last = std::chrono::steady_clock::now();
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last).count();
    last = now;
    return seconds;
  }
};

// What the iterations of both methods share.
struct Run {
  const factor::Problem& problem;
  factor::LinearSystem& system;
  LinearSolver solver;
  const BatchOptions& options;
  factor::Values& values;
  const std::function<void(const Iteration&)>& report;
  BatchResult result;
  std::vector<double> step{}, diagonal{}, gradient{};
};

std::vector<Id> variable_ids(const factor::Problem& problem) {
  std::vector<Id> id;
  for (Index v : problem.variables.variable_vertex) id.push_back(problem.graph->id[v]);
  return id;
}

text::Error diverged(const Run& run) {
  std::string cause = "the iterations diverge: chi-square " + text::format_number(run.result.chi2) +
                      " after " + std::to_string(run.result.iterations) + ", from " +
                      text::format_number(run.result.initial_chi2) + "; start elsewhere (--start)";
  if (run.options.method == BatchMethod::gauss_newton) cause += ", or leave out --gn";
  return text::computation_error(cause);
}

void check_finite(const Run& run) {
  if (!std::isfinite(run.result.chi2)) throw diverged(run);
}

void relinearize(Run& run) {
  factor::linearize(run.problem, run.values, run.options.loss, run.system);
  diagonal_and_gradient(run.system, run.diagonal, run.gradient);
}

// The system of the start is eliminated without damping, which hides what the measurements leave undetermined.
void eliminate_start(Run& run) {
  if (run.solver.eliminate(run.system, {})) return;
  const auto scaling = factor::free_scaling(run.problem, run.values, run.system);
  const NullSpace open = null_space(run.system, scaling);
  run.result.by_qr = open.dimension == 0;
  if (run.result.by_qr) run.solver = qr_solver(run.system, {}, 1);
  if (run.result.by_qr && run.solver.eliminate(run.system, {})) return;
  const bool damped = run.options.method == BatchMethod::levenberg_marquardt;
  run.result.scale_free = damped && open.scale && open.undetermined.empty() && open.lost.empty();
  if (!run.result.scale_free) throw singular_error(open, variable_ids(run.problem));
}

bool small_change(const Run& run, double before, double after) {
  const double tiny = std::numeric_limits<double>::min();
  return std::abs(before - after) <= run.options.tolerance * (std::min(before, after) + tiny);
}

bool is_flat(const Run& run) {
  const double residual = std::sqrt(run.result.chi2);
  for (std::size_t k = 0; k < run.gradient.size(); ++k) {
    if (std::abs(run.gradient[k]) > flat * residual * std::sqrt(run.diagonal[k])) return false;
  }
  return true;
}

// How far rounding alone moves every scalar of a step: half a unit in the last place of the largest coordinate, or of a
// radian, and some more for what is calculated with them.
std::vector<double> rounding_of_estimate(const Run& run) {
  const factor::Problem& problem = run.problem;
  double extent = 0;
  for (Index v = 0; v < problem.graph->vertices(); ++v) {
    const double* const x = run.values.data() + problem.value_at[v];
    for (int k = 0; k < graph::space_dim(problem.space[v]) && k < 3; ++k) {
      if (!factor::is_turn(problem.space[v], k)) extent = std::max(extent, std::abs(x[k]));
    }
  }
  std::vector<double> size;
  for (Index v : problem.variables.variable_vertex) {
    for (int k = 0; k < graph::space_dim(problem.space[v]); ++k)
      size.push_back(2 * rounding * (factor::is_turn(problem.space[v], k) ? 1 : extent));
  }
  return size;
}

// Whether chi2 is what such moves make of 0.
bool is_zero(const Run& run, const std::vector<double>& moves) {
  double sum = 0;
  std::vector<double> most;
  for (Index r = 0; r < run.problem.graph->edges(); ++r) {
    const double* number = run.system.block(r);
    most.assign(run.system.height[r], 0);
    for (Index j : run.system.pattern->rows[r]) {
      for (Index k = run.problem.step_at[j]; k < run.problem.step_at[j + 1]; ++k) {
        for (int i = 0; i < run.system.height[r]; ++i) most[i] += std::abs(*number++) * moves[k];
      }
    }
    sum += std::inner_product(most.begin(), most.end(), most.begin(), 0.0);
  }
  return run.result.chi2 <= sum;
}

// After a step.
bool is_there(const Run& run, double before, double after) {
  if (small_change(run, before, after)) return true;
  const std::vector<double> moves = rounding_of_estimate(run);
  return std::ranges::equal(run.step, moves,
                            [](double d, double most) { return std::abs(d) <= most; }) ||
         is_zero(run, moves);
}

void tell(Run& run, const Iteration& iteration) {
  if (run.report) run.report(iteration);
  run.result.stopped = run.options.stop && run.options.stop();
}

bool goes_on(const Run& run) {
  return run.result.iterations < run.options.iterations && !run.result.stopped;
}

// The step that the system promises. Where the start's was regular and this one is not, the iterations went astray.
void gauss_newton_step(Run& run) {
  if (run.result.iterations == 0) {
    eliminate_start(run);
  } else if (!run.solver.eliminate(run.system, {})) {
    if (run.result.by_qr || null_space(run.system).dimension > 0) throw diverged(run);
    run.result.by_qr = true;
    run.solver = qr_solver(run.system, {}, 1);
    if (!run.solver.eliminate(run.system, {})) throw diverged(run);
  }
  run.solver.back_substitute(run.step);
}

// An end above the start is none: the iterations stall far out. moves: rounding's, at the start.
bool is_below_start(const Run& run, const std::vector<double>& moves) {
  const double start = run.result.initial_chi2, end = run.result.chi2;
  return end <= start || small_change(run, start, end) || is_zero(run, moves);
}

bool gauss_newton(Run& run) {
  BatchResult& result = run.result;
  const std::vector<double> moves = rounding_of_estimate(run);
  while (goes_on(run)) {
    Stopwatch watch;
    try {
      relinearize(run);
    } catch (const text::Error&) {  // far out, edges have no derivative, or weigh too much
      if (result.iterations == 0 || result.chi2 <= result.initial_chi2) throw;
      throw diverged(run);
    }
    const double linearize_s = watch.lap();
    gauss_newton_step(run);
    if (is_flat(run) && is_below_start(run, moves)) return true;
    const double eliminate_s = watch.lap();
    factor::retract(run.problem, run.step, run.values);
    const double before =
        std::exchange(result.chi2, factor::chi2(run.problem, run.values, run.options.loss));
    tell(run,
         {++result.iterations, result.chi2, 0, norm(run.step), true, linearize_s, eliminate_s});
    check_finite(run);
    if (!is_there(run, before, result.chi2)) continue;
    if (!is_below_start(run, moves)) throw diverged(run);
    return true;
  }
  return false;
}

// lambda and how it moves.
struct Damping {
  double lambda = first_lambda;
  double growth = 2;
  double decay = 1.0 / 3;

  void gained(double ratio) {
    lambda = std::max(least_lambda, lambda * std::max(decay, 1 - std::pow(2 * ratio - 1, 3)));
    decay = ratio > 0.9 ? decay / 3 : 1.0 / 3;  // what keeps its promises is let go
    growth = 2;
  }
  void lost() {
    lambda *= growth;
    growth *= 2;
    decay = 1.0 / 3;
  }
};

// What the linearized system promises for the step: g'd + d' (damping) d, where chi2 counts |A d - b|^2 once.
double promised(const std::vector<double>& gradient, const std::vector<double>& damping,
                const std::vector<double>& step) {
  double sum = 0;
  for (std::size_t k = 0; k < step.size(); ++k)
    sum += step[k] * (gradient[k] + damping[k] * step[k]);
  return sum;
}

// Where a walk of undamped steps set out: the best estimate so far, to which it turns back.
struct Walk {
  bool on;  // steps are undamped, and may raise chi2
  factor::Values best;
  double least;    // chi2 of best
  int astray = 0;  // steps since best
  int kept = 0;    // damped steps since the last walk
  int rest = 8;    // so many of them call for the next
};

void turn_back(Run& run, Walk& walk) {
  run.values = walk.best;
  run.result.chi2 = walk.least;
  walk.on = false;
  walk.astray = walk.kept = 0;
  walk.rest *= 2;
}

void note_step(Run& run, Walk& walk) {
  if (run.result.chi2 > walk.least) {
    ++walk.astray;
    return;
  }
  walk.best = run.values;
  walk.least = run.result.chi2;
  walk.astray = 0;
}

// The system of where the steps led; false where there is none, and the walk turned back.
bool relinearize_or_turn_back(Run& run, Walk& walk) {
  try {
    relinearize(run);
    return true;
  } catch (const text::Error&) {  // far out, edges have no derivative, or weigh too much
    if (walk.astray == 0) throw;
    turn_back(run, walk);
    return false;
  }
}

bool levenberg_marquardt(Run& run) {
  BatchResult& result = run.result;
  Stopwatch watch;
  relinearize(run);
  double linearize_s = watch.lap();
  eliminate_start(run);
  if (is_flat(run)) return true;
  Damping damping;
  if (result.by_qr) damping.lambda = first_lambda_by_qr;
  Walk walk{!result.scale_free, run.values, result.chi2};
  std::vector<double> added(run.problem.step_at.back());
  bool stale = false;         // the system is not that of the values
  bool eliminated = walk.on;  // and without damping
  while (goes_on(run) && damping.lambda < largest_lambda) {
    watch.lap();
    if (std::exchange(stale, false)) {
      stale = !relinearize_or_turn_back(run, walk);
      if (stale) continue;
      linearize_s = watch.lap();
      if (walk.astray == 0 && is_flat(run)) return true;
    }
    const double lambda = walk.on ? 0 : damping.lambda;
    std::ranges::transform(run.diagonal, added.begin(), [&](double d) { return lambda * d; });
    if (!std::exchange(eliminated, false) &&
        !run.solver.eliminate(run.system, walk.on ? std::span<const double>{} : added)) {
      if (walk.on) {
        turn_back(run, walk);
        stale = true;
      } else {
        damping.lost();
      }
      continue;
    }
    run.solver.back_substitute(run.step);
    const double eliminate_s = watch.lap();
    factor::Values trial = run.values;
    factor::retract(run.problem, run.step, trial);
    const double after = factor::chi2(run.problem, trial, run.options.loss), before = result.chi2;
    const bool kept = walk.on ? std::isfinite(after) : after <= before;
    if (kept) {
      run.values = std::move(trial);
      result.chi2 = after;
      stale = true;
      note_step(run, walk);
    }
    tell(run, {++result.iterations, after, lambda, norm(run.step), kept, linearize_s, eliminate_s});
    const double promise = promised(run.gradient, added, run.step);
    const bool there = is_there(run, before, after) || promise <= run.options.tolerance * before;
    if (there && (walk.astray == 0 || small_change(run, walk.least, after))) return true;
    if (!walk.on) {
      kept ? damping.gained((before - after) / promise) : damping.lost();
      if (kept && !result.scale_free && ++walk.kept == walk.rest) walk.on = true;
    } else if (there || !kept || walk.astray > patience) {
      turn_back(run, walk);
      stale = true;
    }
  }
  if (walk.astray > 0) turn_back(run, walk);
  return false;
}

}  // namespace

BatchResult optimize(const factor::Problem& problem, factor::LinearSystem& system,
                     const LinearSolver& solver, const BatchOptions& options,
                     factor::Values& values, const std::function<void(const Iteration&)>& report) {
  const double start = factor::chi2(problem, values, options.loss);
  Run run{problem, system, solver, options, values, report, {start, start, 0, false}};
  if (!std::isfinite(start)) {
    relinearize(run);  // which names the edge
    throw text::computation_error("the chi-square of the start is not a finite number");
  }
  run.result.converged =
      options.method == BatchMethod::gauss_newton ? gauss_newton(run) : levenberg_marquardt(run);
  return run.result;
}

text::Error singular_error(const factor::Problem& problem, const factor::Values& values,
                           const factor::LinearSystem& system) {
  return singular_error(null_space(system, factor::free_scaling(problem, values, system)),
                        variable_ids(problem));
}

}  // namespace sg::solve
