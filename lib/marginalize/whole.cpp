#include "lib/marginalize/whole.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "lib/order/order.h"
#include "lib/solve/eliminate.h"
#include "lib/solve/marginals.h"

namespace sg::marginalize {
namespace {

using Eigen::LLT;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using factor::LinearSystem;

constexpr double next_to_nothing =
    1e-9;                         // of what the whole knows: nothing would not be positive definite
constexpr double no_more = 1e-9;  // of what a measurement knows, beside what all know of it

// Variables, and a row for every edge that stays, for every offer, and for what is held.
struct Rest {
  graph::GraphPattern left;
  LinearSystem rows;    // with the offers' whitened slopes
  LinearSystem slopes;  // with their slopes, and zeros
  Index first = 0;      // row of the first offer
};

void append(LinearSystem& system, int height, Eigen::Index columns) {
  system.height.push_back(height);
  system.begin.push_back(system.begin.back() + static_cast<Offset>(height) * (columns + 1));
}

// Appends the offers' rows, with their slopes as numbers.
void append_slopes(std::span<const Offer* const> offers, LinearSystem& system) {
  for (const Offer* offer : offers) {
    append(system, static_cast<int>(offer->slope.rows()), offer->slope.cols());
    system.numbers.resize(system.begin.back(), 0);
    std::copy_n(offer->slope.data(), offer->slope.size(),
                system.numbers.data() + system.begin[system.begin.size() - 2]);
  }
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

void set_rest(const Whole& whole, std::span<const Offer* const> offers, Rest& rest) {
  const Graph& graph = *whole.at.problem.graph;
  graph::Lists<> factors;
  for (const Offer* offer : offers) factors.add(ends_of(offer->of));
  rest.left = pattern_left(graph, whole.removed, whole.edge_gone, factors);
  rest.rows.pattern = rest.slopes.pattern = &rest.left.pattern;
  LinearSystem& rows = rest.rows;
  rows.begin = {0};
  for (Index e = 0; e < graph.edges(); ++e) {
    if (whole.edge_gone[e]) continue;
    const std::span block(whole.edges.block(e), whole.edges.block(e + 1));
    rows.height.push_back(whole.edges.height[e]);
    rows.numbers.insert(rows.numbers.end(), block.begin(), block.end());
    rows.begin.push_back(static_cast<Offset>(rows.numbers.size()));
    hold(whole, rest.left, rest.first++, rows);
  }
  rest.slopes.height = rows.height;
  rest.slopes.begin = rows.begin;
  rest.slopes.numbers.assign(rows.numbers.size(), 0);
  append_slopes(offers, rows);
  append_slopes(offers, rest.slopes);
  if (whole.held < 0) return;
  rest.left.pattern.rows.add(std::vector{rest.left.vertex_variable[whole.held]});
  const int moves = graph::moving_dim(whole.at.space(whole.held)), dim = whole.at.dim(whole.held);
  for (LinearSystem* system : {&rest.rows, &rest.slopes}) {
    append(*system, moves, dim);
    system->numbers.resize(system->begin.back(), 0);
  }
  double* block = rest.rows.block(rest.rows.pattern->rows.size() - 1);
  for (int i = 0; i < moves; ++i) block[i * moves + i] = 1;
}

// U with W = U' U.
MatrixXd root(const MatrixXd& W) {
  const LLT<MatrixXd> cholesky(W);
  if (cholesky.info() == Eigen::Success) return cholesky.matrixU();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> spectrum(W);
  return spectrum.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() *
         spectrum.eigenvectors().transpose();
}

void set_informations(std::span<const Offer* const> offers, const std::vector<MatrixXd>& W,
                      Rest& rest) {
  for (std::size_t k = 0; k < offers.size(); ++k) {
    const MatrixXd block = root(W[k]) * offers[k]->slope;
    std::copy_n(block.data(), block.size(), rest.rows.block(rest.first + static_cast<Index>(k)));
  }
}

graph::Order wmf(const graph::Pattern& pattern) {
  return order::elimination_order("wmf", pattern);
}

// In coordinates in which A = I: the best W beside the others, W itself, and what of the divergence falls along the way
// from the one to the other, for a start.
struct Step {
  MatrixXd to;
  double slope;
};
Step best_beside_others(const MatrixXd& A, const MatrixXd& B, const MatrixXd& W) {
  const LLT<MatrixXd> scale(A);
  const auto L = scale.matrixL();
  const MatrixXd half = L.solve(B), own = L.solve(half.transpose());  // B
  const MatrixXd now = MatrixXd(L).transpose() * W * MatrixXd(L);
  const auto d = A.rows();
  const MatrixXd others = own.llt().solve(MatrixXd::Identity(d, d)) - now;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> spectrum((others + others.transpose()) / 2);
  const VectorXd lacking = (1 - spectrum.eigenvalues().array()).max(next_to_nothing);
  const MatrixXd best =
      spectrum.eigenvectors() * lacking.asDiagonal() * spectrum.eigenvectors().transpose();
  const double slope = ((MatrixXd::Identity(d, d) - own).cwiseProduct(best - now)).sum() / 2;
  const MatrixXd back = L.solve(MatrixXd::Identity(d, d));
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

// The slope of what is offered in its variables, ascending, and these.
struct Slope {
  MatrixXd J;
  std::vector<Index> variables;
};
Slope slope_of(const Whole& whole, const Measurable& of) {
  const MatrixXd all = slope(whole.at, of);
  const int second_at = whole.at.dim(of.first);
  Slope result{MatrixXd(all.rows(), 0), {}};
  for (const Index v : ends_of(of)) {
    const Index j = whole.problem.variables.vertex_variable[v];
    if (j < 0) continue;
    const int dim = whole.at.dim(v);
    result.variables.push_back(j);
    result.J.conservativeResize(Eigen::NoChange, result.J.cols() + dim);
    result.J.rightCols(dim) = all.middleCols(v == of.first ? 0 : second_at, dim);
    if (v == whole.held)
      result.J.middleCols(result.J.cols() - dim, graph::moving_dim(whole.at.space(v))).setZero();
  }
  return result;
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

std::optional<Offered> offered(const Whole& whole, std::span<const Measurable> of) {
  graph::Pattern pattern = whole.problem.variables.pattern;
  LinearSystem rows = whole.edges, slopes = whole.edges;
  rows.pattern = slopes.pattern = &pattern;
  const std::size_t first = rows.height.size();
  Offered result;
  for (const Measurable& measurable : of) {
    Slope own = slope_of(whole, measurable);
    pattern.rows.add(own.variables);
    result.offers.push_back({measurable, std::move(own.J), {}, {}});
  }
  std::vector<const Offer*> all;
  for (const Offer& offer : result.offers) all.push_back(&offer);
  append_slopes(all, slopes);
  append_slopes(all, rows);
  std::fill(rows.numbers.begin() + static_cast<Offset>(whole.edges.numbers.size()),
            rows.numbers.end(), 0.0);
  auto elimination = solve::eliminated(rows, wmf(pattern));
  if (!elimination) return std::nullopt;
  std::vector<MatrixXd> covariances = solve::row_covariances(*elimination, slopes);
  for (std::size_t k = 0; k < all.size(); ++k)
    result.offers[k].truth = std::move(covariances[first + k]);
  const auto beyond = constant(whole, covariances, solve::log_determinant(*elimination));
  if (!beyond) return std::nullopt;
  result.constant = *beyond;
  return result;
}

std::optional<double> fit(const Whole& whole, const graph::Order& order, double gap, int steps,
                          std::vector<Offer>& offers) {
  const std::vector<const Offer*> all = taken(offers);
  Rest rest;
  set_rest(whole, all, rest);
  solve::Elimination elimination = solve::plan_elimination(rest.rows, order);
  std::vector<MatrixXd> W;
  for (const Offer* offer : all) W.push_back(offer->information);
  // The divergence with these informations, infinite where it is not determined.
  const auto divergence = [&](const std::vector<MatrixXd>& information) {
    set_informations(all, information, rest);
    if (!solve::eliminate(elimination, rest.rows).empty())
      return std::numeric_limits<double>::infinity();
    double trace = 0;
    for (std::size_t k = 0; k < all.size(); ++k)
      trace += information[k].cwiseProduct(all[k]->truth).sum();
    return (trace - solve::log_determinant(elimination)) / 2;
  };
  double now = divergence(W);
  if (!std::isfinite(now)) return std::nullopt;
  for (int step = 0; step < steps; ++step) {
    const std::vector<MatrixXd> B = solve::row_covariances(elimination, rest.slopes);
    std::vector<MatrixXd> to;
    double slope = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      Step towards = best_beside_others(all[k]->truth, B[rest.first + k], W[k]);
      slope += towards.slope;
      to.push_back(std::move(towards.to));
    }
    if (!(slope < -gap)) break;
    const auto moved = [&](double length) {
      std::vector<MatrixXd> next = W;
      for (std::size_t k = 0; k < W.size(); ++k) next[k] += length * (to[k] - W[k]);
      return next;
    };
    double length = 1;
    std::vector<MatrixXd> next = moved(length);
    double then = divergence(next);
    while (!(then < now + 0.1 * length * slope) && length > 1e-3) {
      length /= 2;
      next = moved(length);
      then = divergence(next);
    }
    if (!(then < now)) break;
    now = then;
    W = std::move(next);
  }
  std::size_t k = 0;
  for (Offer& offer : offers) {
    if (offer.taken) offer.information = W[k++];
  }
  return now;
}

std::vector<double> worths(const Whole& whole, const std::vector<Offer>& offers) {
  std::vector<const Offer*> all;
  std::vector<MatrixXd> W;
  for (const Offer& offer : offers) {
    all.push_back(&offer);
    const auto d = offer.slope.rows();
    W.push_back(offer.taken ? offer.information : MatrixXd::Zero(d, d));
  }
  Rest rest;
  set_rest(whole, all, rest);
  set_informations(all, W, rest);
  std::vector<double> result(offers.size(), std::numeric_limits<double>::infinity());
  auto elimination = solve::eliminated(rest.rows, wmf(rest.left.pattern));
  if (!elimination) return result;
  const std::vector<MatrixXd> B = solve::row_covariances(*elimination, rest.slopes);
  for (std::size_t k = 0; k < offers.size(); ++k) {
    const MatrixXd& own = B[rest.first + k];
    if (own.size() == 0) {
      result[k] = 0;
    } else if (offers[k].taken) {
      const MatrixXd U = root(W[k]);
      const Eigen::SelfAdjointEigenSolver<MatrixXd> known(U * own * U.transpose(),
                                                          Eigen::EigenvaluesOnly);
      double sum = -W[k].cwiseProduct(offers[k].truth).sum();
      for (const double part : known.eigenvalues())
        sum -= part < 1 - no_more ? std::log1p(-part) : -std::numeric_limits<double>::infinity();
      result[k] = sum / 2;
    } else {
      const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> ratio(offers[k].truth, own,
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
