// Batch optimization: the estimate that minimizes the sum of rho(e' W e) over all edges.
//
// Gauss-Newton takes the linearized system's step as it is. Levenberg-Marquardt adds lambda diag(A' A) to the normal
// equations and keeps a step only if it lowers the sum; lambda follows the ratio of what was gained to what the
// linearized system promised (Nielsen, Damping Parameter in Marquardt's Method, 1999; Madsen, Nielsen, Tingleff,
// Methods for Non-linear Least Squares Problems, 2004, section 3.2).
//
// Alone, that creeps where a long trajectory has to bend. Its slow modes have eigenvalues by many orders below the
// diagonal, so that any lambda holds them back; and the step that bends it raises the sum, by terms of second order in
// the turns, which the next step takes away: asking every step to lower the sum forbids it. So the first steps are
// Gauss-Newton's, and while they go on they may raise the sum: the watchdog technique (Chamberlain, Powell, Lemarechal,
// Pedersen, The watchdog technique for forcing convergence in algorithms for constrained optimization, 1982). If none of
// a few in a row is the best so far, the iterations turn back to the best, and damped steps go on from there; after some
// of these, undamped ones are tried again.
//
// Converged is an estimate that a step changes little (in chi-square, or by nothing but rounding), where the gradient
// vanishes beside what it is summed up from, or whose chi-square is what rounding leaves of 0.
//
// A system whose elimination meets a vanished pivot is judged by its rank (undetermined.h). One that is determined after
// all is solved by QR from there on; where nothing but the scale is free, damping holds it where it is.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "lib/factor/linearize.h"
#include "lib/solve/linear_solver.h"
#include "lib/text/error.h"

namespace sg::solve {

enum class BatchMethod { gauss_newton, levenberg_marquardt };

struct BatchOptions {
  BatchMethod method = BatchMethod::levenberg_marquardt;
  int iterations = 100;     // at most
  double tolerance = 1e-9;  // of the share by which a last step changes chi2
  factor::Loss loss;
  std::function<bool()> stop;  // asked after every iteration, if given: are these enough?
};

struct Iteration {
  int number;                       // 1, 2, ...
  double chi2;                      // after it; with a loss, the sum of rho
  double lambda;                    // 0 for Gauss-Newton
  double step;                      // its length
  bool kept;                        // false: the step raised chi2 and was undone
  double linearize_s, eliminate_s;  // seconds of the two parts
};

struct BatchResult {
  double initial_chi2;
  double chi2;
  int iterations;
  bool converged;
  bool stopped = false;     // by BatchOptions::stop, before that
  bool scale_free = false;  // nothing fixed it: it is near the start's
  bool by_qr = false;       // normal equations lost too many digits
};

// Improves `values` in place; calls `report` (if given) after every iteration. Throws a computation Error that tells a
// system that leaves vertices undetermined, one that is ill-conditioned, and iterations that diverge; and those of
// check_row (linearize.h).
BatchResult optimize(const factor::Problem& problem, factor::LinearSystem& system,
                     const LinearSolver& solver, const BatchOptions& options,
                     factor::Values& values,
                     const std::function<void(const Iteration&)>& report = {});

// The Error for a system, linearized at `values`, that a solver could not eliminate.
text::Error singular_error(const factor::Problem& problem, const factor::Values& values,
                           const factor::LinearSystem& system);

}  // namespace sg::solve
