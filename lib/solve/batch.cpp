#include "lib/solve/batch.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "lib/solve/normal_equations.h"
#include "lib/solve/undetermined.h"

namespace sg {
namespace {

constexpr double first_lambda = 1e-4;
constexpr double least_lambda = 1e-12;
constexpr double largest_lambda = 1e12;

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
  const Problem& problem;
  const Order& order;
  LinearSystem& system;
  const LinearSolver& solver;
  const BatchOptions& options;
  Values& values;
  const std::function<void(const Iteration&)>& report;
  double chi2;
  std::vector<double> step{};
};

void check_finite(double chi2) {
  if (!std::isfinite(chi2)) {
    throw computation_error("the iterations diverge: the estimate has left the finite numbers");
  }
}

void relinearize(Run& run) {
  linearize(run.problem, run.values, run.options.kernel, run.system);
}

bool small_change(const Run& run, double before, double after) {
  const double tiny = std::numeric_limits<double>::min();
  return std::abs(before - after) <= run.options.tolerance * (std::min(before, after) + tiny);
}

void tell(const Run& run, const Iteration& iteration) {
  if (run.report) run.report(iteration);
}

bool gauss_newton(Run& run, int& done) {
  while (done < run.options.iterations) {
    Stopwatch watch;
    relinearize(run);
    const double linearize_s = watch.lap();
    if (!run.solver.eliminate(run.system, {})) {
      throw singular_error(run.problem, run.order, run.system);
    }
    run.solver.back_substitute(run.step);
    const double eliminate_s = watch.lap();
    retract(run.problem, run.step, run.values);
    const double before =
        std::exchange(run.chi2, chi2(run.problem, run.values, run.options.kernel));
    tell(run, {++done, run.chi2, 0, norm(run.step), true, linearize_s, eliminate_s});
    check_finite(run.chi2);
    if (small_change(run, before, run.chi2)) return true;
  }
  return false;
}

// lambda and how it moves.
struct Damping {
  double lambda = first_lambda;
  double growth = 2;

  void gained(double ratio) {
    lambda = std::max(least_lambda, lambda * std::max(1.0 / 3, 1 - std::pow(2 * ratio - 1, 3)));
    growth = 2;
  }
  void lost() {
    lambda *= growth;
    growth *= 2;
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

// Damping hides what the measurements leave undetermined: ask once without.
void check_regular(Run& run) {
  relinearize(run);
  if (!run.solver.eliminate(run.system, {})) {
    throw singular_error(run.problem, run.order, run.system);
  }
}

bool levenberg_marquardt(Run& run, int& done) {
  check_regular(run);
  Damping damping;
  std::vector<double> diagonal, gradient, added(run.problem.step_at.back());
  bool stale = true;  // the system is not that of the values
  double linearize_s = 0;
  while (done < run.options.iterations && damping.lambda < largest_lambda) {
    Stopwatch watch;
    if (stale) {
      relinearize(run);
      diagonal_and_gradient(run.system, diagonal, gradient);
      linearize_s = watch.lap();
    }
    std::ranges::transform(diagonal, added.begin(), [&](double d) { return damping.lambda * d; });
    const double lambda = damping.lambda;
    stale = false;
    if (!run.solver.eliminate(run.system, added)) {
      damping.lost();
      continue;
    }
    run.solver.back_substitute(run.step);
    const double eliminate_s = watch.lap();
    Values trial = run.values;
    retract(run.problem, run.step, trial);
    const double after = chi2(run.problem, trial, run.options.kernel), before = run.chi2;
    const bool kept = after <= before;
    if (kept) {
      run.values = std::move(trial);
      run.chi2 = after;
      stale = true;
    }
    tell(run, {++done, after, lambda, norm(run.step), kept, linearize_s, eliminate_s});
    const double promise = promised(gradient, added, run.step);
    if (small_change(run, before, after) || promise <= run.options.tolerance * before) return true;
    kept ? damping.gained((before - after) / promise) : damping.lost();
  }
  return false;
}

}  // namespace

BatchResult optimize(const Problem& problem, const Order& order, LinearSystem& system,
                     const LinearSolver& solver, const BatchOptions& options, Values& values,
                     const std::function<void(const Iteration&)>& report) {
  Run run{problem, order, system, solver, options, values, report, 0};
  run.chi2 = chi2(problem, values, options.kernel);
  if (!std::isfinite(run.chi2)) relinearize(run);  // which names the edge
  check_finite(run.chi2);
  BatchResult result{run.chi2, run.chi2, 0, false};
  result.converged = options.method == BatchMethod::gauss_newton
                         ? gauss_newton(run, result.iterations)
                         : levenberg_marquardt(run, result.iterations);
  result.chi2 = run.chi2;
  return result;
}

Error singular_error(const Problem& problem, const Order& order, const LinearSystem& system) {
  const auto& ids = problem.graph->id;
  std::vector<Id> undetermined;
  for (Index j : undetermined_variables(system, order)) {
    undetermined.push_back(ids[problem.variables.variable_vertex[j]]);
  }
  return computation_error("the system is singular: the measurements leave " +
                           id_ranges(undetermined) + " undetermined");
}

}  // namespace sg
