#include <memory>

#include "lib/solve/linear_solver.h"
#include "lib/solve/scaled_qr.h"

namespace sg::solve {

LinearSolver qr_solver(const factor::LinearSystem& /*system*/, const graph::Order& /*order*/,
                       int /*threads*/) {
  const auto state = std::make_shared<ScaledQr>();
  return {[state](const factor::LinearSystem& system, std::span<const double> damping) {
            *state = scaled_qr(system, damping);
            return state->qr.dead == 0;
          },
          [state](std::vector<double>& step) {
            step = sparse::back_substitute(state->qr, state->qr.right);
            for (std::size_t k = 0; k < step.size(); ++k) step[k] /= state->length[k];
          }};
}

}  // namespace sg::solve
