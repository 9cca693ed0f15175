#include <algorithm>
#include <memory>

#include "lib/solve/linear_solver.h"
#include "lib/solve/normal_equations.h"
#include "lib/sparse/cholesky.h"

namespace sg {
namespace {

struct State {
  NormalEquations normal;
  Cholmod session;
  CholmodFactor factor{nullptr, {nullptr}};
};

// The diagonal entry of H that L's k-th pivot came from.
double diagonal_entry(const State& state, int k) {
  const int scalar = static_cast<const int*>(state.factor->Perm)[k];
  return state.normal.numbers[state.normal.column_begin[scalar + 1] - 1];
}

// Whether a pivot of the supernodal factor has vanished next to its diagonal entry.
bool has_vanished_pivot(const State& state) {
  const cholmod_factor& L = *state.factor;
  const auto* super = static_cast<const int*>(L.super);
  const auto* pi = static_cast<const int*>(L.pi);
  const auto* px = static_cast<const int*>(L.px);
  const auto* x = static_cast<const double*>(L.x);
  for (std::size_t s = 0; s < L.nsuper; ++s) {
    const int height = pi[s + 1] - pi[s];
    for (int k = super[s]; k < super[s + 1]; ++k) {
      const int column = k - super[s];
      const double pivot = x[px[s] + column * (height + 1)];
      if (!(pivot * pivot > singular_pivot * diagonal_entry(state, k))) return true;
    }
  }
  return false;
}

bool factorize(State& state, const LinearSystem& system, std::span<const double> damping) {
  form_normal_equations(system, damping, state.normal);
  cholmod_sparse H = view(state.normal.column_begin, state.normal.rows, state.normal.numbers);
  return factorize(H, *state.factor, state.session) && !has_vanished_pivot(state);
}

void solve(State& state, std::vector<double>& step) {
  const CholmodDense x = solve(*state.factor, state.normal.gradient, state.session);
  const auto* numbers = static_cast<const double*>(x->x);
  step.resize(state.normal.gradient.size());
  for (std::size_t j = 0; j < state.normal.dim.size(); ++j) {
    std::copy_n(numbers + state.normal.scalar_at[j], state.normal.dim[j],
                step.data() + state.normal.step_at[j]);
  }
}

}  // namespace

LinearSolver cholmod_solver(const LinearSystem& system, const Order& order, int /*threads*/) {
  const auto state = std::make_shared<State>();
  state->normal = normal_structure(system, order);
  if (order.empty()) {  // which CHOLMOD does not take
    return {[](const LinearSystem&, std::span<const double>) { return true; },
            [](std::vector<double>& step) { step.clear(); }};
  }
  state->session.common.supernodal = CHOLMOD_SUPERNODAL;
  state->session.common.quick_return_if_not_posdef = 1;
  NormalEquations& normal = state->normal;
  cholmod_sparse H = view(normal.column_begin, normal.rows, normal.numbers);
  state->factor = analyze(H, CHOLMOD_NATURAL, state->session);
  return {[state](const LinearSystem& s, std::span<const double> damping) {
            return factorize(*state, s, damping);
          },
          [state](std::vector<double>& step) { solve(*state, step); }};
}

}  // namespace sg
