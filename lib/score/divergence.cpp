#include "lib/score/divergence.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <cmath>
#include <numeric>

#include "lib/factor/initialize.h"
#include "lib/factor/linearize.h"
#include "lib/order/order.h"
#include "lib/solve/marginals.h"

namespace sg::score {
namespace {

using Eigen::VectorXd;
using factor::LinearSystem;
using factor::Problem;
using factor::Values;

bool has_models(const Graph& graph) {
  for (Index e = 0; e < graph.edges(); ++e) {
    if (factor::has_no_model(graph.edge_tag(e))) return false;
  }
  return true;
}

// The reference's variable of every one of the graph's; nothing where they are not the same.
std::optional<std::vector<Index>> matched(const Problem& problem, const Problem& reference) {
  std::vector<Index> variables;
  for (Index v = 0; v < problem.graph->vertices(); ++v) {
    const auto u = graph::find_vertex(*reference.graph, problem.graph->id[v]);
    if (!u || problem.space[v] != reference.space[*u]) return std::nullopt;
    const Index j = reference.variables.vertex_variable[*u];
    if ((problem.variables.vertex_variable[v] < 0) != (j < 0)) return std::nullopt;
    if (j >= 0) variables.push_back(j);
  }
  return variables;
}

Values values_of(const Problem& problem, const Problem& reference, const Values& from) {
  Values values;
  for (const Id id : problem.graph->id) {
    const Index u = *graph::find_vertex(*reference.graph, id);
    values.insert(values.end(), from.begin() + reference.value_at[u],
                  from.begin() + reference.value_at[u + 1]);
  }
  return values;
}

// Nothing where it is singular.
std::optional<solve::Elimination> eliminated(const LinearSystem& system) {
  return solve::eliminated(system, order::elimination_order("wmf", *system.pattern));
}

// Two systems in the variables of the first, one below the other; of one of them the numbers.
struct Both {
  graph::Pattern pattern;
  LinearSystem reference, graph;  // of the other there are zeros
};

void append(const LinearSystem& from, bool numbers, LinearSystem& to) {
  for (std::size_t r = 0; r < from.height.size(); ++r) {
    to.height.push_back(from.height[r]);
    to.begin.push_back(to.begin.back() + from.begin[r + 1] - from.begin[r]);
  }
  const std::size_t at = to.numbers.size();
  to.numbers.resize(to.begin.back(), 0);
  if (numbers) std::ranges::copy(from.numbers, to.numbers.begin() + static_cast<Offset>(at));
}

void stack(const LinearSystem& reference, const LinearSystem& graph,
           const std::vector<Index>& variables, Both& both) {
  both.pattern = *reference.pattern;
  for (Index r = 0; r < graph.pattern->rows.size(); ++r) {
    for (const Index j : graph.pattern->rows[r]) both.pattern.rows.items.push_back(variables[j]);
    both.pattern.rows.close();
  }
  for (LinearSystem* system : {&both.reference, &both.graph}) {
    system->pattern = &both.pattern;
    system->begin.assign(1, 0);
    append(reference, system == &both.reference, *system);
    append(graph, system == &both.graph, *system);
  }
}

// A x and A' y of some rows of a system.
struct Rows {
  const LinearSystem& system;
  Index first;  // and all behind it
  std::vector<Index> step_at;

  Eigen::Index size() const {
    return std::accumulate(system.height.begin() + first, system.height.end(), Eigen::Index{0});
  }
  void each(const auto& visit) const {
    Eigen::Index row = 0;
    for (Index r = first; r < system.pattern->rows.size(); ++r) {
      const double* block = system.block(r);
      const int height = system.height[r];
      for (const Index j : system.pattern->rows[r]) {
        const int dim = system.pattern->dim[j];
        visit(row, step_at[j], Eigen::Map<const Eigen::MatrixXd>(block, height, dim));
        block += height * dim;
      }
      row += height;
    }
  }
  VectorXd times(const VectorXd& x) const {
    VectorXd y = VectorXd::Zero(size());
    each([&](Eigen::Index row, Index at, const auto& A) {
      y.segment(row, A.rows()) += A * x.segment(at, A.cols());
    });
    return y;
  }
  VectorXd transposed_times(const VectorXd& y) const {
    VectorXd x = VectorXd::Zero(step_at.back());
    each([&](Eigen::Index row, Index at, const auto& A) {
      x.segment(at, A.cols()) += A.transpose() * y.segment(row, A.rows());
    });
    return x;
  }
};

constexpr int most_steps = 200;
constexpr double tolerance = 1e-7;

// Of A S A', whose eigenvalues are those of W S, and zeros: by the method of Lanczos, every vector made orthogonal to all
// before. It ends when the space is exhausted, as where all eigenvalues are one.
double largest_eigenvalue(const Rows& rows, solve::Elimination& elimination) {
  boost::random::mt19937 random(1);
  const Eigen::Index size = rows.size();
  VectorXd v(size);
  for (double& x : v) x = boost::random::uniform_real_distribution<>(-1, 1)(random);
  Eigen::MatrixXd basis(size, 0), projected;
  double largest = 0;
  for (int k = 0; k < std::min<Eigen::Index>(size, most_steps); ++k) {
    basis.conservativeResize(Eigen::NoChange, k + 1);
    basis.col(k) = v.normalized();
    VectorXd x = rows.transposed_times(basis.col(k));
    solve::solve_normal_equations(elimination, x);
    v = rows.times(x);
    projected.conservativeResize(k + 1, k + 1);
    projected.col(k) = basis.transpose() * v;
    projected.row(k) = projected.col(k).transpose();
    for (int again = 0; again < 2; ++again) v -= basis * (basis.transpose() * v);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(projected);
    largest = ritz.eigenvalues()[k];
    const double residual = v.norm() * std::abs(ritz.eigenvectors()(k, k));
    if (residual <= tolerance * largest) break;
  }
  return largest;
}

// Holds this variable instead of the one that is held.
void hold(Problem& problem, Index variable) {
  problem.held = variable;
  problem.variables.pattern.rows.items.back() = variable;
}

}  // namespace

std::optional<Divergence> divergence(const Graph& graph, const Graph& reference) {
  if (!has_models(graph) || !has_models(reference)) return std::nullopt;
  const Problem own = factor::make_problem(graph);
  Problem full = factor::make_problem(reference);
  const auto variables = matched(own, full);
  if (!variables || variables->empty() || (own.held < 0) != (full.held < 0)) return std::nullopt;
  if (own.held >= 0) hold(full, (*variables)[own.held]);
  const Values values = factor::start_values(full);
  const LinearSystem p = factor::linearized(full, values),
                     q = factor::linearized(own, values_of(own, full, values));
  Both both;
  stack(p, q, *variables, both);
  auto of_p = eliminated(both.reference), of_q = eliminated(q);
  std::vector<bool> is_rest(p.pattern->variables(), true);
  for (const Index j : *variables) is_rest[j] = false;
  const auto rest = solve::log_determinant_given_others(p, is_rest);
  if (!of_p || !of_q || !rest) return std::nullopt;

  const Rows rows{both.graph, p.pattern->rows.size(), of_p->step_at};
  std::vector<double> step_p, step_q;
  solve::back_substitute(*of_p, step_p);
  solve::back_substitute(*of_q, step_q);
  VectorXd apart = Eigen::Map<const VectorXd>(step_p.data(), std::ssize(step_p));
  double dim = 0;
  for (std::size_t k = 0; k < variables->size(); ++k) {
    const int size = own.variables.pattern.dim[k];
    apart.segment(of_p->step_at[(*variables)[k]], size) -=
        Eigen::Map<const VectorXd>(step_q.data() + of_q->step_at[k], size);
    dim += size;
  }
  const std::vector<double> variances = solve::row_variances(*of_p, both.graph);
  const double trace = std::accumulate(variances.begin(), variances.end(), 0.0);
  const double log_det_p = solve::log_determinant(*of_p) - *rest;
  const double log_det_q = solve::log_determinant(*of_q);
  const double kld = (trace - dim + rows.times(apart).squaredNorm() - log_det_q + log_det_p) / 2;
  return Divergence{std::max(0.0, kld), largest_eigenvalue(rows, *of_p)};
}

}  // namespace sg::score
