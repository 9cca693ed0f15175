// Batch optimization: the estimate that minimizes the sum of rho(e' W e) over all edges.
//
// Gauss-Newton takes the linearized system's step as it is. Levenberg-Marquardt adds lambda diag(A' A) to the normal
// equations and keeps a step only if it lowers the sum; lambda follows the ratio of what was gained to what the
// linearized system promised (Nielsen, Damping Parameter in Marquardt's Method, 1999; Madsen, Nielsen, Tingleff,
// Methods for Non-linear Least Squares Problems, 2004, section 3.2).
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "lib/factor/linearize.h"
#include "lib/solve/linear_solver.h"
#include "lib/text/error.h"

namespace sg {

enum class BatchMethod { gauss_newton, levenberg_marquardt };

struct BatchOptions {
  BatchMethod method = BatchMethod::levenberg_marquardt;
  int iterations = 100;     // at most
  double tolerance = 1e-9;  // converged: a step changes chi2 by no more than this share of it
  Kernel kernel;
};

struct Iteration {
  int number;                       // 1, 2, ...
  double chi2;                      // after it; with a kernel, the sum of rho
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
};

// Improves `values` in place; calls `report` (if given) after every iteration. Throws a computation Error that names
// the undetermined vertices of a singular system, one when the estimate leaves the finite numbers, and those of
// check_row (linearize.h).
BatchResult optimize(const Problem& problem, const Order& order, LinearSystem& system,
                     const LinearSolver& solver, const BatchOptions& options, Values& values,
                     const std::function<void(const Iteration&)>& report = {});

// The Error for a singular system.
Error singular_error(const Problem& problem, const Order& order, const LinearSystem& system);

}  // namespace sg
