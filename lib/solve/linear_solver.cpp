#include "lib/solve/linear_solver.h"

#include <array>
#include <memory>

#include "lib/solve/eliminate.h"
#include "lib/text/error.h"
#include "lib/text/nearest.h"

namespace sg::solve {
namespace {

LinearSolver tree_solver(const factor::LinearSystem& system, const graph::Order& order,
                         int threads) {
  const auto plan = std::make_shared<Elimination>(plan_elimination(system, order, threads));
  return {[plan](const factor::LinearSystem& s, std::span<const double> damping) {
            return eliminate(*plan, s, damping).empty();
          },
          [plan](std::vector<double>& step) { back_substitute(*plan, step); }};
}

constexpr std::array table{
    Backend{"tree", "multifrontal Cholesky on the Bayes tree", tree_solver},
    Backend{"cholmod", "sparse Cholesky by CHOLMOD", cholmod_solver},
    Backend{"qr", "multifrontal QR by SPQR", qr_solver},
};

}  // namespace

std::span<const Backend> backends() {
  return table;
}

std::string backend_names() {
  return text::listed(text::names_of(table));
}

const Backend& find_backend(std::string_view name) {
  for (const Backend& backend : table) {
    if (backend.name == name) return backend;
  }
  throw text::usage_error(text::no_such("backend", name, text::names_of(table)));
}

}  // namespace sg::solve
