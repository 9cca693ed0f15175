#include "lib/marginalize/recover.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace sg::marginalize {
namespace {

using Eigen::Index;
using Eigen::LLT;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double first_barrier = 0.1, shrink = 0.0215;
constexpr int most_steps = 30;  // of Newton, for one barrier

// The problem in coordinates of its own: S = I and J_k J_k' = I. Then A_k = I, and the unknown V_k is W_k as a multiple
// of what a tree would have.
struct Scaled {
  std::vector<MatrixXd> J;
  MatrixXd stacked;               // all of them
  std::vector<Index> at;          // where each begins there
  std::vector<MatrixXd> unscale;  // C_k^-1 with A_k = C_k C_k': W_k = C_k^-T V_k C_k^-1
  Index m;
};

Scaled scaled(std::span<const MatrixXd> slopes, const MatrixXd& covariance) {
  const MatrixXd L = LLT<MatrixXd>(covariance).matrixL();
  Scaled problem{{}, {}, {}, {}, covariance.rows()};
  Index rows = 0;
  for (const MatrixXd& slope : slopes) {
    const MatrixXd J = slope * L;
    const LLT<MatrixXd> A(J * J.transpose());
    problem.J.push_back(A.matrixL().solve(J));
    problem.unscale.push_back(A.matrixL().solve(MatrixXd::Identity(J.rows(), J.rows())));
    problem.at.push_back(rows);
    rows += J.rows();
  }
  problem.stacked.resize(rows, problem.m);
  for (std::size_t k = 0; k < problem.J.size(); ++k)
    problem.stacked.middleRows(problem.at[k], problem.J[k].rows()) = problem.J[k];
  return problem;
}

using Blocks = std::vector<MatrixXd>;  // V_k, or a step of them

MatrixXd information(const Scaled& problem, const Blocks& V) {
  MatrixXd Q = MatrixXd::Zero(problem.m, problem.m);
  for (std::size_t k = 0; k < V.size(); ++k)
    Q.noalias() += problem.J[k].transpose() * V[k] * problem.J[k];
  return Q;
}

double objective(const Scaled& problem, const Blocks& V, const RecoveryOptions& options,
                 double barrier) {
  const MatrixXd Q = information(problem, V);
  double value = -log_det(Q);
  for (const MatrixXd& block : V)
    value += (1 + options.penalty) * block.trace() - barrier * log_det(block);
  if (options.conservative)
    value -= barrier * log_det(MatrixXd::Identity(problem.m, problem.m) - Q);
  return value;
}

// The unknowns of a symmetric block: its upper triangle, row by row; or what the identity is multiplied by, i = -1.
struct Unknown {
  int block;
  int i, j;
};

std::vector<Unknown> unknowns(const Blocks& V, bool multiples) {
  std::vector<Unknown> result;
  for (int k = 0; k < static_cast<int>(V.size()); ++k) {
    if (multiples) {
      result.push_back({k, -1, -1});
      continue;
    }
    for (int i = 0; i < V[k].rows(); ++i) {
      for (int j = i; j < V[k].rows(); ++j) result.push_back({k, i, j});
    }
  }
  return result;
}

// tr(P E P' F) with E, F the unit steps of two unknowns, P the block that joins theirs.
double curvature(const Eigen::Ref<const MatrixXd>& P, const Unknown& f, const Unknown& e) {
  if (f.i < 0) return P.squaredNorm();
  const double straight = P(f.i, e.i) * P(f.j, e.j), crossed = P(f.i, e.j) * P(f.j, e.i);
  const bool f_off = f.i != f.j, e_off = e.i != e.j;
  if (f_off && e_off) return 2 * (straight + crossed);
  return f_off || e_off ? 2 * straight : straight;
}

// tr(E M) of a symmetric M.
double along(const Eigen::Ref<const MatrixXd>& M, const Unknown& e) {
  if (e.i < 0) return M.trace();
  return e.i == e.j ? M(e.i, e.i) : 2 * M(e.i, e.j);
}

// Newton's step, and how much of a decrease it promises.
struct Newton {
  Blocks step;
  double decrement;
};

// curved: the barrier that the curvature is of.
Newton newton(const Scaled& problem, const Blocks& V, const RecoveryOptions& options,
              double barrier, double curved) {
  const MatrixXd& all = problem.stacked;
  const std::vector<Index>& at = problem.at;
  const MatrixXd Q = information(problem, V);
  const MatrixXd P = all * LLT<MatrixXd>(Q).solve(all.transpose());
  MatrixXd room;  // what the conservative barrier has in P's place
  if (options.conservative)
    room = all * LLT<MatrixXd>(MatrixXd::Identity(problem.m, problem.m) - Q).solve(all.transpose());
  Blocks inverse;
  for (const MatrixXd& block : V)
    inverse.push_back(LLT<MatrixXd>(block).solve(MatrixXd::Identity(block.rows(), block.rows())));

  const std::vector<Unknown> unknown = unknowns(V, options.multiples);
  const auto count = static_cast<Index>(unknown.size());
  MatrixXd hessian(count, count);
  VectorXd gradient(count);
  for (Index a = 0; a < count; ++a) {
    const Unknown& f = unknown[a];
    const Index rows = V[f.block].rows();
    for (Index b = 0; b <= a; ++b) {
      const Unknown& e = unknown[b];
      const Index columns = V[e.block].rows();
      double value = curvature(P.block(at[f.block], at[e.block], rows, columns), f, e);
      if (f.block == e.block) value += curved * curvature(inverse[f.block], f, e);
      if (options.conservative)
        value += curved * curvature(room.block(at[f.block], at[e.block], rows, columns), f, e);
      hessian(a, b) = value;
    }
    const auto own = [&](const MatrixXd& of) {
      return of.block(at[f.block], at[f.block], V[f.block].rows(), V[f.block].rows());
    };
    const double weight = f.i < 0 ? static_cast<double>(V[f.block].rows()) : f.i == f.j ? 1 : 0;
    gradient[a] =
        (1 + options.penalty) * weight - along(own(P), f) - barrier * along(inverse[f.block], f);
    if (options.conservative) gradient[a] += barrier * along(own(room), f);
  }
  const VectorXd step = LLT<MatrixXd>(hessian.selfadjointView<Eigen::Lower>()).solve(-gradient);
  Newton result{V, -gradient.dot(step)};
  for (Index a = 0; a < count; ++a) {
    const Unknown& f = unknown[a];
    MatrixXd& block = result.step[f.block];
    if (f.i < 0) {
      block = step[a] * MatrixXd::Identity(block.rows(), block.rows());
    } else {
      block(f.i, f.j) = block(f.j, f.i) = step[a];
    }
  }
  return result;
}

Blocks moved(const Blocks& V, const Blocks& step, double length) {
  Blocks result = V;
  for (std::size_t k = 0; k < V.size(); ++k) result[k] += length * step[k];
  return result;
}

// before: the barrier that V is the minimum of.
void minimize(const Scaled& problem, const RecoveryOptions& options, double barrier, double before,
              Blocks& V) {
  for (int step = 0; step < most_steps; ++step) {
    const Newton towards = newton(problem, V, options, barrier, step == 0 ? before : barrier);
    if (!(towards.decrement > 1e-2 * barrier)) return;  // beside the gap that the barrier leaves
    const double now = objective(problem, V, options, barrier);
    double length = 1;
    Blocks next = moved(V, towards.step, length);
    while (!(objective(problem, next, options, barrier) < now - 0.1 * length * towards.decrement)) {
      length /= 2;
      if (length < 1e-8) return;  // rounding
      next = moved(V, towards.step, length);
    }
    V = std::move(next);
  }
}

constexpr double next_to_nothing = 1e-10;  // of a tree's: nothing would not be positive definite
// Sets every block in turn to its best beside the others.
void fit_in_turn(const Scaled& problem, const RecoveryOptions& options, Blocks& V) {
  const auto m = static_cast<double>(problem.m);
  for (int sweep = 0; sweep < options.sweeps; ++sweep) {
    MatrixXd P =
        LLT<MatrixXd>(information(problem, V)).solve(MatrixXd::Identity(problem.m, problem.m));
    double excess = 0, trace = 0;
    for (std::size_t k = 0; k < V.size(); ++k) {
      const MatrixXd PJ = P * problem.J[k].transpose(), B = problem.J[k] * PJ;
      const auto d = B.rows();
      trace += V[k].trace();
      const Eigen::SelfAdjointEigenSolver<MatrixXd> own(B);
      excess = std::max(excess, own.eigenvalues()[d - 1] - 1);
      const MatrixXd known = own.eigenvectors() * own.eigenvalues().cwiseInverse().asDiagonal() *
                                 own.eigenvectors().transpose() -
                             V[k];
      const Eigen::SelfAdjointEigenSolver<MatrixXd> rest(known);
      const VectorXd lacking = (1 - rest.eigenvalues().array()).max(next_to_nothing);
      const MatrixXd next =
          rest.eigenvectors() * lacking.asDiagonal() * rest.eigenvectors().transpose();
      const MatrixXd more = next - V[k];
      P.noalias() -=
          PJ * (MatrixXd::Identity(d, d) + more * B).partialPivLu().solve(more) * PJ.transpose();
      V[k] = next;
    }
    if (trace - m + excess * m < options.gap) return;  // of what it was before this sweep
  }
}

}  // namespace

double log_det(const MatrixXd& matrix) {
  const LLT<MatrixXd> cholesky(matrix);
  if (cholesky.info() != Eigen::Success) return -std::numeric_limits<double>::infinity();
  return 2 * MatrixXd(cholesky.matrixL()).diagonal().array().log().sum();
}

Recovery recover(std::span<const MatrixXd> slopes, const MatrixXd& covariance,
                 const RecoveryOptions& options) {
  const Scaled problem = scaled(slopes, covariance);
  Index rows = 0;
  Blocks V;
  for (const MatrixXd& J : problem.J) {
    rows += J.rows();
    V.push_back(MatrixXd::Identity(J.rows(), J.rows()));
  }
  const bool closed_form = rows == problem.m && !options.conservative && options.penalty == 0;
  const bool plain = !options.conservative && options.penalty == 0 && !options.multiples;
  if (plain && !closed_form && unknowns(V, false).size() > most_unknowns) {
    fit_in_turn(problem, options, V);
  } else if (!closed_form) {
    // Each J_k' J_k is a projection: with less than one over their number, the sum is below I.
    const double start = options.conservative
                             ? 0.9 / static_cast<double>(V.size())
                             : static_cast<double>(problem.m) / static_cast<double>(rows);
    for (MatrixXd& block : V) block *= start;
    double before = first_barrier;
    for (double barrier = first_barrier; barrier > options.barrier; barrier *= shrink) {
      minimize(problem, options, barrier, before, V);
      before = barrier;
    }
  }
  Recovery result;
  const MatrixXd Q = information(problem, V);
  result.divergence = (Q.trace() - static_cast<double>(problem.m) - log_det(Q)) / 2;
  for (std::size_t k = 0; k < V.size(); ++k) {
    const MatrixXd W = problem.unscale[k].transpose() * V[k] * problem.unscale[k];
    result.information.push_back((W + W.transpose()) / 2);
  }
  return result;
}

}  // namespace sg::marginalize
