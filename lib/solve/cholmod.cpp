#include "lib/solve/cholmod.h"

#include <algorithm>

#include "lib/solve/linear_solver.h"
#include "lib/text/error.h"

namespace sg {
namespace {

struct State {
  NormalEquations normal;
  CholmodCommon cholmod;
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
  cholmod_sparse H = view(state.normal);
  cholmod_factorize(&H, state.factor.get(), &state.cholmod.common);
  if (state.cholmod.common.status < CHOLMOD_OK)
    throw computation_error("CHOLMOD ran out of memory");
  return state.cholmod.common.status == CHOLMOD_OK && !has_vanished_pivot(state);
}

void solve(State& state, std::vector<double>& step) {
  cholmod_common& common = state.cholmod.common;
  cholmod_dense g = view(state.normal.gradient);
  const CholmodDense x(cholmod_solve(CHOLMOD_A, state.factor.get(), &g, &common), {&common});
  const auto* numbers = static_cast<const double*>(x->x);
  step.resize(state.normal.gradient.size());
  for (std::size_t j = 0; j < state.normal.dim.size(); ++j) {
    std::copy_n(numbers + state.normal.scalar_at[j], state.normal.dim[j],
                step.data() + state.normal.step_at[j]);
  }
}

}  // namespace

cholmod_sparse view(NormalEquations& normal) {
  cholmod_sparse H{};
  H.nrow = H.ncol = normal.gradient.size();
  H.nzmax = normal.rows.size();
  H.p = normal.column_begin.data();
  H.i = normal.rows.data();
  H.x = normal.numbers.data();
  H.stype = 1;
  H.itype = CHOLMOD_INT;
  H.xtype = CHOLMOD_REAL;
  H.dtype = CHOLMOD_DOUBLE;
  H.sorted = H.packed = 1;
  return H;
}

cholmod_dense view(std::vector<double>& column) {
  cholmod_dense dense{};
  dense.nrow = dense.nzmax = dense.d = column.size();
  dense.ncol = 1;
  dense.x = column.data();
  dense.xtype = CHOLMOD_REAL;
  dense.dtype = CHOLMOD_DOUBLE;
  return dense;
}

CholmodFactor analyze(NormalEquations& normal, cholmod_common& common) {
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_NATURAL;
  common.postorder = 1;
  common.print = 0;
  cholmod_sparse H = view(normal);
  return {cholmod_analyze(&H, &common), {&common}};
}

LinearSolver cholmod_solver(const LinearSystem& system, const Order& order, int /*threads*/) {
  const auto state = std::make_shared<State>();
  state->normal = normal_structure(system, order);
  if (order.empty()) {  // which CHOLMOD does not take
    return {[](const LinearSystem&, std::span<const double>) { return true; },
            [](std::vector<double>& step) { step.clear(); }};
  }
  state->cholmod.common.supernodal = CHOLMOD_SUPERNODAL;
  state->cholmod.common.quick_return_if_not_posdef = 1;
  state->factor = analyze(state->normal, state->cholmod.common);
  if (!state->factor) throw computation_error("CHOLMOD ran out of memory");
  return {[state](const LinearSystem& s, std::span<const double> damping) {
            return factorize(*state, s, damping);
          },
          [state](std::vector<double>& step) { solve(*state, step); }};
}

}  // namespace sg
