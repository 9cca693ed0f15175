#include "lib/marginalize/errors.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "lib/graph/components.h"
#include "lib/sparse/cholesky.h"

namespace sg::marginalize {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_corrections = 10;               // of what damping leaves
constexpr double exactly = 1e-12, roughly = 1e-4;  // what they may leave
constexpr int most_steps = 40;                     // of a measurement
constexpr double enough = 1e-14;                   // of its error
constexpr int most_halvings = 30;
constexpr double near_enough = 1e-6, least_turn = 0.1;
constexpr double closer = 0.7;     // than before, or the slope is renewed
constexpr double smallest = 1e-4;  // part of a step
// Added to the information of every scalar, as a part of it: next to nothing may be known of some directions.
constexpr double damping = 1e-10;

struct Settlement {
  const At& at;
  std::span<const Spring> springs;
  std::vector<int> start;   // of every vertex in the scalars of all
  std::vector<bool> moves;  // vertices
};

// Calls visit(v) for its vertices, as they follow each other in its slope.
void each_end(const Measurable& of, const auto& visit) {
  visit(of.first);
  if (of.second >= 0) visit(of.second);
}

// One vertex of every part that only moves with the whole is held, and so are constants.
std::vector<bool> moving(const At& at, std::span<const Spring> springs) {
  const Graph& graph = *at.problem.graph;
  graph::DisjointSets parts(graph.vertices() + 1);  // the last: the world
  std::vector<bool> moves(graph.vertices(), false);
  for (const Spring& spring : springs) {
    join(parts, spring.of.first, spring.of.second < 0 ? graph.vertices() : spring.of.second);
    each_end(spring.of, [&](Index v) { moves[v] = true; });
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
  std::vector<int> places;
  MatrixXd W;
  for (const Spring& spring : s.springs) {
    W.noalias() = spring.slope.transpose() * (spring.information * spring.slope);
    places.clear();
    each_end(spring.of, [&](Index v) {
      for (int i = s.start[v]; i < s.start[v + 1]; ++i) places.push_back(system.place[i]);
    });
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

// Its slope times a step of all vertices.
VectorXd along(const Settlement& s, const Spring& spring, const VectorXd& x) {
  VectorXd own(spring.slope.cols());
  int row = 0;
  each_end(spring.of, [&](Index v) {
    own.segment(row, s.at.dim(v)) = x.segment(s.start[v], s.at.dim(v));
    row += s.at.dim(v);
  });
  return spring.slope * own;
}

// What is owed beyond the gradient that errors J_k x would have, were slopes what they are without errors.
VectorXd still_owed(const Settlement& s, const VectorXd& owed, const VectorXd& x) {
  VectorXd rest = owed;
  for (const Spring& spring : s.springs) {
    const VectorXd force = spring.slope.transpose() * (spring.information * along(s, spring, x));
    int row = 0;
    each_end(spring.of, [&](Index v) {
      rest.segment(s.start[v], s.at.dim(v)) -= force.segment(row, s.at.dim(v));
      row += s.at.dim(v);
    });
  }
  return rest;
}

// A measurement as if its last vertex had moved by y from where the estimates have it.
struct Moved {
  const At& at;
  const Measurable& of;
  MatrixXd back;  // from its slope without an error: J^+

  std::vector<double> numbers(const VectorXd& y) const {
    const VectorXd none = VectorXd::Zero(of.second < 0 ? 0 : at.dim(of.first));
    return of.second < 0 ? measured(at, of, y, none) : measured(at, of, none, y);
  }
  // M: its slope is M J.
  MatrixXd turn(const std::vector<double>& numbers) const { return slope(at, of, numbers) * back; }
  // How far its error is from M error.
  VectorXd rest(const VectorXd& y, const VectorXd& error) const {
    const std::vector<double> z = numbers(y);
    return turn(z) * error - lack(at, of, z);
  }
};

MatrixXd numerical_slope(const Moved& moved, const VectorXd& y, const VectorXd& error) {
  constexpr double h = 1e-6;
  MatrixXd result(y.size(), y.size());
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    const VectorXd unit = h * VectorXd::Unit(y.size(), i);
    result.col(i) = (moved.rest(y + unit, error) - moved.rest(y - unit, error)) / (2 * h);
  }
  return result;
}

// y with which nothing is left of `rest`. Newton's method, with the slope J of the measurement as long as that comes closer
// fast. information: to measure by.
VectorXd solved(const Moved& moved, const VectorXd& error, const MatrixXd& J,
                const MatrixXd& information) {
  const auto size = [&](const VectorXd& r) { return std::sqrt(r.dot(information * r)); };
  const Eigen::PartialPivLU<MatrixXd> first(J);
  VectorXd y = first.solve(error), rest = moved.rest(y, error);
  bool anew = false;
  for (int step = 0; step < most_steps && size(rest) > enough * size(error); ++step) {
    const VectorXd towards =
        anew ? VectorXd(-numerical_slope(moved, y, error).partialPivLu().solve(rest))
             : VectorXd(first.solve(rest));
    double length = 1;
    VectorXd next = y + towards, then = moved.rest(next, error);
    if (!anew && !(size(then) < closer * size(rest))) {
      anew = true;
      continue;
    }
    while (!(size(then) < size(rest)) && length > smallest) {
      length /= 2;
      next = y + length * towards;
      then = moved.rest(next, error);
    }
    if (!(size(then) < size(rest))) break;
    y = next;
    rest = then;
  }
  return y;
}

// Where no measurement has the error, as a rotation has none of more than half a turn, or next to nothing could be told with
// it, it gets a half of it, or a half of that.
void set_error(const Settlement& s, const Spring& spring, const VectorXd& x, Measurement& m) {
  const VectorXd whole = along(s, spring, x);
  if (whole.isZero(0)) return;
  const MatrixXd &J = spring.slope,
                 own = J.rightCols(s.at.dim(m.of.second < 0 ? m.of.first : m.of.second));
  const auto d = J.rows();
  const Moved moved{s.at, m.of,
                    J.transpose() * (J * J.transpose()).llt().solve(MatrixXd::Identity(d, d))};
  const auto size = [&](const VectorXd& r) { return std::sqrt(r.dot(m.information * r)); };
  VectorXd error = whole;
  for (int halved = 0; halved < most_halvings; ++halved, error /= 2) {
    const VectorXd y = solved(moved, error, own, m.information);
    const std::vector<double> z = moved.numbers(y);
    const Eigen::PartialPivLU<MatrixXd> turn(moved.turn(z));
    if (!(size(moved.rest(y, error)) < near_enough * size(error)) || !(turn.rcond() > least_turn))
      continue;
    m.numbers = z;
    const MatrixXd half = turn.transpose().solve(m.information);
    const MatrixXd W = turn.transpose().solve(half.transpose());
    m.information = (W + W.transpose()) / 2;
    return;
  }
}

// x, by scalar of all vertices; nothing where nothing moves.
std::optional<VectorXd> displacement(const Settlement& s, const VectorXd& owed, double rest_of) {
  System system;
  if (!factor_system(s, system)) return std::nullopt;
  const double whole = size(system, owed);
  VectorXd x = VectorXd::Zero(owed.size()), rest = owed;
  for (int k = 0; k < most_corrections && size(system, rest) > rest_of * whole; ++k) {
    const VectorXd next = x + solved(system, rest), then = still_owed(s, owed, next);
    if (!(size(system, then) < size(system, rest))) break;
    x = next;
    rest = then;
  }
  return x;
}

}  // namespace

void set_errors(const At& at, const VectorXd& owed, std::span<Measurement* const> measurements) {
  std::vector<MatrixXd> slopes;
  slopes.reserve(measurements.size());
  std::vector<Spring> springs;
  for (const Measurement* m : measurements) {
    slopes.push_back(slope(at, m->of));
    springs.push_back({m->of, slopes.back(), m->information});
  }
  const Settlement s{at, springs, starts_of_all(at), moving(at, springs)};
  const auto x = displacement(s, owed, exactly);
  if (!x) return;
  for (std::size_t k = 0; k < springs.size(); ++k) set_error(s, springs[k], *x, *measurements[k]);
}

std::vector<double> strains(const At& at, const VectorXd& owed, std::span<const Spring> springs) {
  const Settlement s{at, springs, starts_of_all(at), moving(at, springs)};
  const auto x = displacement(s, owed, roughly);
  std::vector<double> result;
  for (const Spring& spring : springs) {
    const VectorXd error = x ? along(s, spring, *x) : VectorXd::Zero(spring.slope.rows());
    result.push_back(error.dot(spring.information * error) / 2);
  }
  return result;
}

}  // namespace sg::marginalize
