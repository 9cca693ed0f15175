// What solves a linearized system: a table of backends with one face.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lib/factor/linearize.h"

namespace sg::solve {

struct LinearSolver {
  // Eliminates all variables. damping: what is added to the diagonal of A' A, by scalar of a step; empty for nothing.
  // False for a singular system.
  std::function<bool(const factor::LinearSystem&, std::span<const double> damping)> eliminate;
  // After eliminate: the step, by scalar.
  std::function<void(std::vector<double>& step)> back_substitute;
};

struct Backend {
  std::string_view name;
  std::string_view what;
  // Plans for this structure and order, which later systems share.
  LinearSolver (*make)(const factor::LinearSystem& system, const graph::Order& order, int threads);
};

// The first is the default.
std::span<const Backend> backends();
// Throws a usage Error that lists the names.
const Backend& find_backend(std::string_view name);
std::string backend_names();  // "a, b"

// Cholesky by CHOLMOD (Chen, Davis, Hager, Rajamanickam 2008) on the normal equations in this order: supernodal, or simplicial
// where it finds that quicker.
LinearSolver cholmod_solver(const factor::LinearSystem& system, const graph::Order& order,
                            int threads);

// Multifrontal QR by SPQR in an order of its own (scaled_qr.h): several times slower, and right where the normal
// equations of the others have lost the digits that count.
LinearSolver qr_solver(const factor::LinearSystem& system, const graph::Order& order, int threads);

}  // namespace sg::solve
