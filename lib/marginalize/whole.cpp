#include "lib/marginalize/whole.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "lib/order/order.h"
#include "lib/solve/marginals.h"

namespace sg::marginalize {
namespace {

using Eigen::LLT;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using factor::LinearSystem;
// Of a measurement, whose numbers are no more than a pose's: they stand where they are used, as there are thousands.
using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 6, 6>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 6, 1>;

constexpr double next_to_nothing =
    1e-9;                         // of what the whole knows: nothing would not be positive definite
constexpr double no_more = 1e-9;  // of what a measurement knows, beside what all know of it

// Appends a row with the slope of what is offered, in those of its vertices that vary, ascending. number: of every
// vertex's variable.
void append_slope(const Whole& whole, const Offer& offer, std::span<const Index> number,
                  LinearSystem& system) {
  const auto height = static_cast<int>(offer.slope.rows());
  std::vector<double>& numbers = system.numbers;
  for (const Index v : ends_of(offer.of)) {
    if (number[v] < 0) continue;
    const int held = v == whole.held ? graph::moving_dim(whole.at.space(v)) : 0;
    numbers.insert(numbers.end(), static_cast<std::size_t>(height) * held, 0.0);
    const double* const first =
        offer.slope.data() +
        static_cast<Offset>(height) * (v == offer.of.first ? 0 : whole.at.dim(offer.of.first));
    numbers.insert(numbers.end(), first + static_cast<Offset>(height) * held,
                   first + static_cast<Offset>(height) * whole.at.dim(v));
  }
  numbers.insert(numbers.end(), height, 0.0);
  system.height.push_back(height);
  system.begin.push_back(static_cast<Offset>(numbers.size()));
}

// Sets the columns of what moves of the held vertex in row r to zero.
void hold(const Whole& whole, const graph::GraphPattern& left, Index r, LinearSystem& system) {
  int column = 0;
  for (const Index j : left.pattern.rows[r]) {
    const Index v = left.variable_vertex[j];
    if (v == whole.held) {
      const int moves = graph::moving_dim(whole.at.space(v)), height = system.height[r];
      std::fill_n(system.block(r) + static_cast<Offset>(column) * height, moves * height, 0.0);
    }
    column += left.pattern.dim[j];
  }
}

// U with W = U' U.
Small root(const MatrixXd& W) {
  const LLT<Small> cholesky(W);
  if (cholesky.info() == Eigen::Success) return cholesky.matrixU();
  const Eigen::SelfAdjointEigenSolver<Small> spectrum(W);
  return spectrum.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() *
         spectrum.eigenvectors().transpose();
}

// Of the k-th offer: what whitens its slope.
void set_information(const MatrixXd& W, Index k, Rest& rest) {
  const Index r = rest.first + k;
  const auto height = rest.rows.height[r];
  const auto columns = (rest.rows.begin[r + 1] - rest.rows.begin[r]) / height;
  const Eigen::Map<const MatrixXd> slope(rest.slopes.block(r), height, columns);
  Eigen::Map<MatrixXd>(rest.rows.block(r), height, columns) = root(W).lazyProduct(slope);
}

graph::Order wmf(const graph::Pattern& pattern) {
  return order::elimination_order("wmf", pattern);
}

// In coordinates in which A = I: the best W beside the others, W itself, and what of the divergence falls along the way
// from the one to the other, for a start.
struct Step {
  Small to;
  double slope;
};
Step best_beside_others(const MatrixXd& A, const MatrixXd& B, const MatrixXd& W) {
  const LLT<Small> scale(A);
  const auto L = scale.matrixL();
  const auto d = A.rows();
  const Small identity = Small::Identity(d, d), back = L.solve(identity);  // L^-1
  const Small own = back * B * back.transpose(), now = Small(L).transpose() * W * Small(L);
  const Small others = LLT<Small>(own).solve(identity) - now;
  const Eigen::SelfAdjointEigenSolver<Small> spectrum((others + others.transpose()) / 2);
  const SmallVector lacking = (1 - spectrum.eigenvalues().array()).max(next_to_nothing);
  const Small best =
      spectrum.eigenvectors() * lacking.asDiagonal() * spectrum.eigenvectors().transpose();
  const double slope = (identity - own).cwiseProduct(best - now).sum() / 2;
  return {back.transpose() * best * back, slope};
}

std::vector<const Offer*> taken(const std::vector<Offer>& offers) {
  std::vector<const Offer*> result;
  for (const Offer& offer : offers) {
    if (offer.taken) result.push_back(&offer);
  }
  return result;
}

Index first_that_stays(const Graph& graph, const std::vector<bool>& removed) {
  Index first = -1;
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (removed[v] || graph.fixed[v]) continue;
    if (graph.role(v) == graph::Role::pose) return v;
    if (first < 0) first = v;
  }
  return first;
}

// The divergence of what is left less what `fit` returns: of what does not depend on informations.
std::optional<double> constant(const Whole& whole, std::span<const MatrixXd> edges,
                               double log_det) {
  const graph::GraphPattern& variables = whole.problem.variables;
  std::vector<bool> goes(variables.pattern.variables(), false);
  double dim = 0, trace = 0;
  for (Index j = 0; j < variables.pattern.variables(); ++j) {
    const Index v = variables.variable_vertex[j];
    goes[j] = whole.removed[v];
    if (goes[j]) continue;
    dim += variables.pattern.dim[j];
    if (v == whole.held) dim -= graph::moving_dim(whole.at.space(v));
  }
  for (Index e = 0; e < std::ssize(whole.edge_gone); ++e) {
    if (!whole.edge_gone[e] && edges[e].size() > 0) trace += edges[e].trace();
  }
  const auto rest = solve::log_determinant_given_others(whole.edges, goes);
  if (!rest) return std::nullopt;
  return (trace - dim + log_det - *rest) / 2;
}

}  // namespace

Whole::Whole(const At& where, const std::vector<bool>& gone, const std::vector<bool>& edges_gone)
    : at(where), removed(gone), edge_gone(edges_gone), problem(where.problem) {
  if (problem.held >= 0) {
    held = problem.variables.variable_vertex[problem.held];
    if (removed[held]) held = first_that_stays(*problem.graph, removed);
    problem.held = problem.variables.vertex_variable[held];
    problem.variables.pattern.rows.items.back() = problem.held;
  }
  edges = factor::linearized(problem, at.values);
}

Rest::Rest(const Whole& whole, std::span<const Offer* const> offers,
           const std::function<graph::Order(const graph::Pattern&)>& order) {
  const Graph& graph = *whole.at.problem.graph;
  graph::Lists<> factors;
  for (const Offer* offer : offers) factors.add(ends_of(offer->of));
  left = pattern_left(graph, whole.removed, whole.edge_gone, factors);
  rows.pattern = slopes.pattern = &left.pattern;
  rows.begin = {0};
  for (Index e = 0; e < graph.edges(); ++e) {
    if (whole.edge_gone[e]) continue;
    const std::span block(whole.edges.block(e), whole.edges.block(e + 1));
    rows.height.push_back(whole.edges.height[e]);
    rows.numbers.insert(rows.numbers.end(), block.begin(), block.end());
    rows.begin.push_back(static_cast<Offset>(rows.numbers.size()));
    hold(whole, left, first++, rows);
  }
  slopes.height = rows.height;
  slopes.begin = rows.begin;
  slopes.numbers.assign(rows.numbers.size(), 0);
  for (const Offer* offer : offers) append_slope(whole, *offer, left.vertex_variable, slopes);
  if (whole.held >= 0) {
    left.pattern.rows.add(std::vector{left.vertex_variable[whole.held]});
    const int moves = graph::moving_dim(whole.at.space(whole.held));
    slopes.height.push_back(moves);
    slopes.numbers.resize(slopes.numbers.size() + moves * (whole.at.dim(whole.held) + 1), 0);
    slopes.begin.push_back(static_cast<Offset>(slopes.numbers.size()));
  }
  rows.height = slopes.height;
  rows.begin = slopes.begin;
  rows.numbers.resize(slopes.numbers.size(), 0);
  if (whole.held >= 0) {
    double* block = rows.block(rows.pattern->rows.size() - 1);
    const int moves = rows.height.back();
    for (int i = 0; i < moves; ++i) block[i * moves + i] = 1;
  }
  elimination = solve::plan_elimination(rows, order(left.pattern));
}

std::optional<Offered> offered(const Whole& whole, std::span<const Measurable> of) {
  graph::Pattern pattern = whole.problem.variables.pattern;
  const std::vector<Index>& number = whole.problem.variables.vertex_variable;
  LinearSystem rows = whole.edges, slopes = whole.edges;
  rows.pattern = slopes.pattern = &pattern;
  const std::size_t first = rows.height.size();
  Offered result;
  std::vector<Index> row;
  for (const Measurable& measurable : of) {
    result.offers.push_back({measurable, slope(whole.at, measurable), {}, {}});
    append_slope(whole, result.offers.back(), number, slopes);
    row.clear();
    for (const Index v : ends_of(measurable)) {
      if (number[v] >= 0) row.push_back(number[v]);
    }
    pattern.rows.add(row);
  }
  rows.height = slopes.height;
  rows.begin = slopes.begin;
  rows.numbers.resize(slopes.numbers.size(), 0);
  auto elimination = solve::eliminated(rows, wmf(pattern));
  if (!elimination) return std::nullopt;
  std::vector<MatrixXd> covariances = solve::row_covariances(*elimination, slopes);
  for (std::size_t k = 0; k < result.offers.size(); ++k)
    result.offers[k].truth = std::move(covariances[first + k]);
  const auto beyond = constant(whole, covariances, solve::log_determinant(*elimination));
  if (!beyond) return std::nullopt;
  result.constant = *beyond;
  return result;
}

std::optional<double> fit(const Whole& whole, const graph::Order& order, double gap, int steps,
                          std::vector<Offer>& offers) {
  const std::vector<const Offer*> all = taken(offers);
  Rest rest(whole, all, [&](const graph::Pattern&) { return order; });
  std::vector<MatrixXd> W;
  W.reserve(all.size());
  for (const Offer* offer : all) W.push_back(offer->information);
  // The divergence with these informations, infinite where it is not determined.
  const auto divergence = [&](const std::vector<MatrixXd>& information) {
    double trace = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      set_information(information[k], static_cast<Index>(k), rest);
      trace += information[k].cwiseProduct(all[k]->truth).sum();
    }
    if (!solve::eliminate(rest.elimination, rest.rows).empty())
      return std::numeric_limits<double>::infinity();
    return (trace - solve::log_determinant(rest.elimination)) / 2;
  };
  double now = divergence(W);
  if (!std::isfinite(now)) return std::nullopt;
  std::vector<MatrixXd> to = W, next = W;
  for (int step = 0; step < steps; ++step) {
    const std::vector<MatrixXd> B = solve::row_covariances(rest.elimination, rest.slopes);
    double slope = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const Step towards = best_beside_others(all[k]->truth, B[rest.first + k], W[k]);
      slope += towards.slope;
      to[k] = towards.to;
    }
    if (!(slope < -gap)) break;
    // The divergence after this part of the step.
    const auto moved = [&](double length) {
      for (std::size_t k = 0; k < W.size(); ++k) next[k] = W[k] + length * (to[k] - W[k]);
      return divergence(next);
    };
    double length = 1, then = moved(length);
    while (!(then < now + 0.1 * length * slope) && length > 1e-3) {
      length /= 2;
      then = moved(length);
    }
    if (!(then < now)) break;
    now = then;
    std::swap(W, next);
  }
  std::size_t k = 0;
  for (Offer& offer : offers) {
    if (offer.taken) offer.information = W[k++];
  }
  return now;
}

std::vector<double> worths(const std::vector<Offer>& offers, Rest& all) {
  for (Index k = 0; k < std::ssize(offers); ++k) {
    const Index r = all.first + k;
    if (offers[k].taken) {
      set_information(offers[k].information, k, all);
    } else {
      std::fill(all.rows.block(r), all.rows.block(r + 1), 0.0);
    }
  }
  std::vector<double> result(offers.size(), std::numeric_limits<double>::infinity());
  if (!solve::eliminate(all.elimination, all.rows).empty()) return result;
  const std::vector<MatrixXd> B = solve::row_covariances(all.elimination, all.slopes);
  for (std::size_t k = 0; k < offers.size(); ++k) {
    const MatrixXd& own = B[all.first + k];
    if (own.size() == 0) {
      result[k] = 0;
    } else if (offers[k].taken) {
      const Small U = root(offers[k].information);
      const Eigen::SelfAdjointEigenSolver<Small> known(U * own * U.transpose(),
                                                       Eigen::EigenvaluesOnly);
      double sum = -offers[k].information.cwiseProduct(offers[k].truth).sum();
      for (const double part : known.eigenvalues())
        sum -= part < 1 - no_more ? std::log1p(-part) : -std::numeric_limits<double>::infinity();
      result[k] = sum / 2;
    } else {
      const Eigen::GeneralizedSelfAdjointEigenSolver<Small> ratio(offers[k].truth, own,
                                                                  Eigen::EigenvaluesOnly);
      double sum = 0;
      for (const double r : ratio.eigenvalues()) sum += r < 1 ? r - 1 - std::log(r) : 0;
      result[k] = sum / 2;
    }
  }
  return result;
}

graph::GraphPattern pattern_left(const Whole& whole, const std::vector<Offer>& offers) {
  graph::Lists<> factors;
  for (const Offer& offer : offers) {
    if (offer.taken) factors.add(ends_of(offer.of));
  }
  return pattern_left(*whole.at.problem.graph, whole.removed, whole.edge_gone, factors);
}

}  // namespace sg::marginalize
