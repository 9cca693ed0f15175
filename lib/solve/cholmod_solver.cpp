#include <algorithm>
#include <memory>

#include "lib/solve/linear_solver.h"
#include "lib/solve/normal_equations.h"
#include "lib/solve/pivots.h"
#include "lib/sparse/cholesky.h"

namespace sg::solve {
namespace {

struct State {
  NormalEquations normal;
  std::vector<double> floors;  // of pivots, by scalar in elimination order
  sparse::Cholmod session;
  sparse::CholmodFactor factor{nullptr, {nullptr}};
};

// Whether a pivot has vanished.
bool has_vanished_pivot(const State& state) {
  const cholmod_factor& L = *state.factor;
  const auto* x = static_cast<const double*>(L.x);
  const auto* scalar = static_cast<const int*>(L.Perm);
  if (!L.is_super) {  // L D L', with D on the diagonal, or L L'
    const auto* begin = static_cast<const int*>(L.p);
    for (std::size_t k = 0; k < L.n; ++k) {
      const double entry = x[begin[k]];
      if (!((L.is_ll ? entry * entry : entry) > state.floors[scalar[k]])) return true;
    }
    return false;
  }
  const auto* super = static_cast<const int*>(L.super);
  const auto* pi = static_cast<const int*>(L.pi);
  const auto* px = static_cast<const int*>(L.px);
  for (std::size_t s = 0; s < L.nsuper; ++s) {
    const int height = pi[s + 1] - pi[s];
    for (int k = super[s]; k < super[s + 1]; ++k) {
      const double root = x[px[s] + diagonal_at(k - super[s], height)];
      if (!(root * root > state.floors[scalar[k]])) return true;
    }
  }
  return false;
}

bool factorize(State& state, const factor::LinearSystem& system, std::span<const double> damping) {
  form_normal_equations(system, damping, state.normal);
  set_floors(system, state.normal.scalar_at, state.floors);
  cholmod_sparse H =
      sparse::view(state.normal.column_begin, state.normal.rows, state.normal.numbers);
  return sparse::factorize(H, *state.factor, state.session) && !has_vanished_pivot(state);
}

void solve(State& state, std::vector<double>& step) {
  const sparse::CholmodDense x = sparse::solve(*state.factor, state.normal.gradient, state.session);
  const auto* numbers = static_cast<const double*>(x->x);
  step.resize(state.normal.gradient.size());
  for (std::size_t j = 0; j < state.normal.dim.size(); ++j) {
    std::copy_n(numbers + state.normal.scalar_at[j], state.normal.dim[j],
                step.data() + state.normal.step_at[j]);
  }
}

}  // namespace

LinearSolver cholmod_solver(const factor::LinearSystem& system, const graph::Order& order,
                            int /*threads*/) {
  const auto state = std::make_shared<State>();
  state->normal = normal_structure(system, order);
  state->floors.resize(state->normal.scalars());
  if (order.empty()) {  // which CHOLMOD does not take
    return {[](const factor::LinearSystem&, std::span<const double>) { return true; },
            [](std::vector<double>& step) { step.clear(); }};
  }
  state->session.common.quick_return_if_not_posdef = 1;
  NormalEquations& normal = state->normal;
  cholmod_sparse H = sparse::view(normal.column_begin, normal.rows, normal.numbers);
  state->factor = sparse::analyze(H, CHOLMOD_NATURAL, state->session);
  return {[state](const factor::LinearSystem& s, std::span<const double> damping) {
            return factorize(*state, s, damping);
          },
          [state](std::vector<double>& step) { solve(*state, step); }};
}

}  // namespace sg::solve
