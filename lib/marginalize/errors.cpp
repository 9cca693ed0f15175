#include "lib/marginalize/errors.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <deque>

#include "lib/graph/components.h"
#include "lib/sparse/cholesky.h"

namespace sg::marginalize {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_steps = 40;
constexpr int remembered = 5;     // steps
constexpr double enough = 1e-10;  // of what is owed
// Added to the information of every scalar, as a part of it: next to nothing may be known of some directions.
constexpr double damping = 1e-10;

struct Settlement {
  const At& at;
  std::span<Measurement* const> measurements;
  std::vector<MatrixXd> information;  // of every measurement without an error
  bool conservative;
  std::vector<int> start;   // of every vertex in the scalars of all
  std::vector<bool> moves;  // vertices
  VectorXd owed;            // but to those that do not

  std::vector<Index> ends(const Measurement& m) const {
    return m.of.second < 0 ? std::vector{m.of.first} : std::vector{m.of.first, m.of.second};
  }
  VectorXd of(const VectorXd& x, Index v) const {
    return v < 0 ? VectorXd(0) : VectorXd(x.segment(start[v], at.dim(v)));
  }
};

// One vertex of every part that only moves with the whole is held, and so are constants.
std::vector<bool> moving(const At& at, std::span<Measurement* const> measurements) {
  const Graph& graph = *at.problem.graph;
  graph::DisjointSets parts(graph.vertices() + 1);  // the last: the world
  std::vector<bool> moves(graph.vertices(), false);
  for (const Measurement* m : measurements) {
    join(parts, m->of.first, m->of.second < 0 ? graph.vertices() : m->of.second);
    for (const Index v : {m->of.first, m->of.second}) {
      if (v >= 0) moves[v] = true;
    }
  }
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (!graph.fixed[v] || !moves[v]) continue;
    moves[v] = false;
    join(parts, v, graph.vertices());
  }
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (moves[v] && join(parts, v, graph.vertices())) moves[v] = false;
  }
  return moves;
}

// How many times more than without its error it knows, in some direction: its slope is M times what it was.
double growth(const At& at, const Measurement& m, const MatrixXd& information) {
  const MatrixXd before = slope(at, m.of);
  const MatrixXd M =
      slope(at, m.of, m.numbers) * before.transpose() *
      (before * before.transpose()).llt().solve(MatrixXd::Identity(before.rows(), before.rows()));
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> ratios(
      M.transpose() * information * M, information, Eigen::EigenvaluesOnly);
  return ratios.eigenvalues().maxCoeff();
}

// Makes the measurements those of vertices that have moved by x, and returns the gradient that is still owed.
VectorXd still_owed(const Settlement& s, const VectorXd& x) {
  VectorXd rest = s.owed;
  for (std::size_t k = 0; k < s.measurements.size(); ++k) {
    Measurement& m = *s.measurements[k];
    m.numbers = measured(s.at, m.of, s.of(x, m.of.first), s.of(x, m.of.second));
    m.information = s.information[k];
    if (s.conservative) m.information /= std::max(1.0, growth(s.at, m, s.information[k]));
    const Piece piece = piece_of(s.at, m);
    int row = 0;
    for (const Index v : piece.vertices) {
      const int dim = s.at.dim(v);
      if (s.moves[v]) rest.segment(s.start[v], dim) -= piece.gradient.segment(row, dim);
      row += dim;
    }
  }
  return rest;
}

// The system of all slopes as they are without errors, in the scalars that move.
struct System {
  std::vector<int> place;  // of every scalar, -1 of one that does not move
  VectorXd diagonal;
  sparse::Cholmod session;
  sparse::CholmodFactor factor;
};

bool factor_system(const Settlement& s, System& system) {
  system.place.assign(s.start.back(), -1);
  int count = 0;
  for (Index v = 0; v < std::ssize(s.moves); ++v) {
    for (int i = s.start[v]; s.moves[v] && i < s.start[v + 1]; ++i) system.place[i] = count++;
  }
  if (count == 0) return false;
  system.diagonal = VectorXd::Zero(count);
  sparse::Triplets lower;
  for (std::size_t k = 0; k < s.measurements.size(); ++k) {
    const Measurement& m = *s.measurements[k];
    const MatrixXd J = slope(s.at, m.of), W = J.transpose() * s.information[k] * J;
    std::vector<int> places;
    for (const Index v : s.ends(m)) {
      for (int i = s.start[v]; i < s.start[v + 1]; ++i) places.push_back(system.place[i]);
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
      for (std::size_t j = 0; j < places.size(); ++j) {
        if (places[j] < 0 || places[i] < places[j]) continue;
        lower.add(places[i], places[j], W(i, j));
        if (i == j) system.diagonal[places[i]] += W(i, i);
      }
    }
  }
  for (int i = 0; i < count; ++i) lower.add(i, i, damping * system.diagonal[i]);
  const auto matrix = sparse::sparse_matrix(count, lower, system.session);
  system.factor = sparse::analyze(*matrix, CHOLMOD_AMD, system.session);
  return sparse::factorize(*matrix, *system.factor, system.session);
}

VectorXd solved(System& system, const VectorXd& gradient) {
  std::vector<double> b(system.diagonal.size());
  for (Eigen::Index i = 0; i < gradient.size(); ++i) {
    if (system.place[i] >= 0) b[system.place[i]] = gradient[i];
  }
  const auto x = sparse::solve(*system.factor, b, system.session);
  VectorXd step = VectorXd::Zero(gradient.size());
  for (Eigen::Index i = 0; i < gradient.size(); ++i) {
    if (system.place[i] >= 0) step[i] = static_cast<const double*>(x->x)[system.place[i]];
  }
  return step;
}

// In the units of every scalar.
double size(const System& system, const VectorXd& gradient) {
  double sum = 0;
  for (Eigen::Index i = 0; i < gradient.size(); ++i) {
    if (system.place[i] >= 0)
      sum += gradient[i] * gradient[i] / std::max(system.diagonal[system.place[i]], 1e-300);
  }
  return std::sqrt(sum);
}

VectorXd weights(const System& system) {
  VectorXd weight = VectorXd::Zero(system.place.size());
  for (Eigen::Index i = 0; i < weight.size(); ++i) {
    if (system.place[i] >= 0) weight[i] = std::sqrt(system.diagonal[system.place[i]]);
  }
  return weight;
}

// The last changes of x, and what they changed of the step that a fixed system gives there.
struct Memory {
  std::deque<VectorXd> moved, changed;
  VectorXd x, step;
};

// A step that learns from those before how the slopes of measurements change with their errors (Anderson, Iterative
// procedures for nonlinear integral equations, 1965).
VectorXd accelerated(Memory& memory, const VectorXd& weight, const VectorXd& x,
                     const VectorXd& step) {
  if (memory.x.size() > 0) {
    memory.moved.push_back(x - memory.x);
    memory.changed.push_back(step - memory.step);
    if (std::ssize(memory.moved) > remembered) {
      memory.moved.pop_front();
      memory.changed.pop_front();
    }
  }
  memory.x = x;
  memory.step = step;
  const auto count = static_cast<Eigen::Index>(memory.moved.size());
  if (count == 0) return step;
  MatrixXd changed(x.size(), count);
  for (Eigen::Index k = 0; k < count; ++k) changed.col(k) = weight.cwiseProduct(memory.changed[k]);
  const VectorXd share = changed.colPivHouseholderQr().solve(weight.cwiseProduct(step));
  VectorXd result = step;
  for (Eigen::Index k = 0; k < count; ++k)
    result -= share[k] * (memory.moved[k] + memory.changed[k]);
  return result;
}

}  // namespace

void set_errors(const At& at, const VectorXd& owed, bool conservative,
                std::span<Measurement* const> measurements) {
  Settlement s{at, measurements, {}, conservative, {0}, moving(at, measurements), owed};
  for (Index v = 0; v < at.problem.graph->vertices(); ++v) {
    s.start.push_back(s.start.back() + at.dim(v));
    if (!s.moves[v]) s.owed.segment(s.start[v], at.dim(v)).setZero();
  }
  for (const Measurement* m : measurements) s.information.push_back(m->information);
  System system;
  if (!factor_system(s, system)) return;
  const VectorXd weight = weights(system);
  const double whole = size(system, s.owed);
  VectorXd x = VectorXd::Zero(owed.size()), rest = s.owed, best = x;
  double least = whole;
  Memory memory;
  for (int k = 0; k < most_steps && least > enough * whole; ++k) {
    x += accelerated(memory, weight, x, solved(system, rest));
    rest = still_owed(s, x);
    if (size(system, rest) < least) {
      least = size(system, rest);
      best = x;
    }
  }
  still_owed(s, best);
}

}  // namespace sg::marginalize
