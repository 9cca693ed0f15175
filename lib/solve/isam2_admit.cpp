#include "lib/solve/isam2_admit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <numeric>

#include "lib/factor/space.h"
#include "lib/solve/isam2_covariance.h"

namespace sg::solve {
namespace {

using Eigen::MatrixXd;

// Of a variable by the rows that bring it: below this share of its largest singular value it is not determined.
constexpr double rank_tolerance = 1e-4;

bool holds(const Isam2& isam, const Isam2Clique& clique, Index j) {
  const auto found = [j](std::span<const Index> list) {
    return std::ranges::find(list, j) != list.end();
  };
  return found(frontals_of(isam.tree, clique)) || found(separators_of(isam.tree, clique));
}

double raised(const Isam2Clique& clique, double dim) {
  const double n = clique.f + clique.s;
  return clique.f * ((n + dim) * (n + dim) - n * n);
}

// Of putting variable v into all cliques from u's to the nearest that holds it: up to where the ways meet, and down again.
double price_of_way(const Isam2& isam, Index u, Index v) {
  const std::vector<Isam2Clique>& cliques = isam.tree.cliques;
  const double dim = pattern_of(isam).dim[v];
  double sum = 0;
  std::vector<Index> way;
  for (Index c = isam.tree.variable_clique[u]; c >= 0; c = cliques[c].parent) {
    if (holds(isam, cliques[c], v)) return sum;
    sum += raised(cliques[c], dim);
    way.push_back(c);
  }
  // v stands below the root on another way: from its clique up to where that meets u's.
  double other = 0;
  Index c = isam.tree.variable_clique[v];
  for (; c >= 0; c = cliques[c].parent) {
    const auto meets = std::ranges::find(way, c);
    if (meets != way.end()) {
      for (auto above = meets + 1; above != way.end(); ++above) sum -= raised(cliques[*above], dim);
      break;
    }
    if (!holds(isam, cliques[c], v)) other += raised(cliques[c], dim);
  }
  return c < 0 ? std::numeric_limits<double>::infinity() : sum + other;
}

// The position's scalars of a variable's step.
std::pair<int, int> position_of(const Isam2& isam, Index j) {
  const graph::Axes axes =
      graph::facts(isam.problem->space[isam.problem->variables.variable_vertex[j]]).translation;
  return {axes.first, axes.size};
}

}  // namespace

Measurement measurement(const Isam2& isam, std::span<const Index> rows, Index variable) {
  const factor::Problem& problem = *isam.problem;
  const graph::Pattern& all = pattern_of(isam);
  Measurement result;
  std::vector<Index> column_at;
  Index width = 0, height = 0;
  for (Index r : rows) {
    height += factor::block_rows(problem, r);
    for (Index j : all.rows[r]) {
      if (j == variable || std::ranges::count(result.variables, j) > 0) continue;
      result.variables.push_back(j);
      column_at.push_back(width);
      width += all.dim[j];
    }
  }
  MatrixXd others = MatrixXd::Zero(height, width);
  MatrixXd own = MatrixXd::Zero(height, variable < 0 ? 0 : all.dim[variable]);
  std::vector<double> block;
  Index at = 0;
  for (Index r : rows) {
    const int h = factor::block_rows(problem, r);
    block.resize(h * factor::block_columns(all, r));
    factor::linearize_row(problem, isam.linearized, {}, r, block.data());
    const Eigen::Map<const MatrixXd> jacobian(block.data(), h, factor::block_columns(all, r));
    Index column = 0;
    for (Index j : all.rows[r]) {
      const auto part = jacobian.middleCols(column, all.dim[j]);
      if (j == variable) {
        own.middleRows(at, h) += part;
      } else {
        const auto k = std::ranges::find(result.variables, j) - result.variables.begin();
        others.block(at, column_at[k], h, all.dim[j]) += part;
      }
      column += all.dim[j];
    }
    at += h;
  }
  if (variable >= 0) {
    Eigen::ColPivHouseholderQR<MatrixXd> qr;
    qr.setThreshold(rank_tolerance);
    qr.compute(own);
    if (qr.rank() < own.cols()) return {};
    others.applyOnTheLeft(qr.householderQ().adjoint());
    others = others.bottomRows(height - own.cols()).eval();
  }
  result.jacobian = std::move(others);
  return result;
}

double gain(Isam2& isam, const Measurement& m, std::span<const Index> place, bool given_back) {
  const MatrixXd& J = m.jacobian;
  const MatrixXd S = covariance(isam, m.variables);
  const MatrixXd seen = J * S;
  MatrixXd inner = seen * J.transpose();
  if (given_back) inner = -inner;
  inner.diagonal().array() += 1;
  const Eigen::LDLT<MatrixXd> ldlt(inner);
  if (given_back && !(ldlt.vectorD().minCoeff() > 1e-9))
    return std::numeric_limits<double>::infinity();
  const MatrixXd weighed = ldlt.solve(seen);
  const Eigen::VectorXd fall = (seen.array() * weighed.array()).colwise().sum();  // of variances
  // By place.
  std::vector<std::pair<Index, double>> falls;
  Index column = 0;
  for (Index j : m.variables) {
    const auto [first, size] = position_of(isam, j);
    falls.emplace_back(place[j], fall.segment(column + first, size).sum());
    column += pattern_of(isam).dim[j];
  }
  std::ranges::sort(falls);
  double sum = falls.back().second;
  for (std::size_t k = 1; k < falls.size(); ++k) {
    const double poses = falls[k].first - falls[k - 1].first;
    sum += poses * (falls[k].second + falls[k - 1].second) / 2;
  }
  return sum;
}

double price(const Isam2& isam, std::span<const Index> variables, int extra) {
  double sum = 0, dim = extra;
  for (std::size_t k = 0; k < variables.size(); ++k) {
    dim += pattern_of(isam).dim[variables[k]];
    if (k == 0) continue;
    sum += std::min(price_of_way(isam, variables[k - 1], variables[k]),
                    price_of_way(isam, variables[k], variables[k - 1]));
  }
  return sum + extra * dim * dim;
}

}  // namespace sg::solve
