#include "lib/prune/information_gain.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "lib/solve/marginals.h"

namespace sg::prune {
namespace {

using Eigen::MatrixXd;
using solve::Rows;

// Of a landmark by the rows that bring it: below this share of its largest singular value it is not determined.
constexpr double rank_tolerance = 1e-4;
// Columns of right-hand sides at a time: memory stays linear.
constexpr Index strip = 64;

Eigen::Map<const MatrixXd> jacobian_of(const Evidence& evidence, Index r) {
  const int height = evidence.height[r];
  const auto columns = height == 0 ? 0 : (evidence.begin[r + 1] - evidence.begin[r]) / height - 1;
  return {evidence.block(r), height, columns};
}

// J x of rows in elimination order.
Draws product(const Knowledge& knowledge, const Measurement& m, const Draws& x) {
  Draws result = Draws::Zero(m.jacobian.rows(), draws);
  Eigen::Index at = 0;
  for (const Index j : m.variables) {
    const int dim = knowledge.evidence.pattern.dim[j];
    result.noalias() +=
        m.jacobian.middleCols(at, dim).lazyProduct(x.middleRows(knowledge.triangle.row(j), dim));
    at += dim;
  }
  return result;
}

// The rows that are in, and for every variable that is not a row that holds it.
void select_rows(Knowledge& knowledge, const Selection& in) {
  const Evidence& evidence = knowledge.evidence;
  const graph::Pattern& all = evidence.pattern;
  knowledge.pattern = {all.dim, {}};
  knowledge.selected = {nullptr, {}, {0}, {}};
  factor::LinearSystem& selected = knowledge.selected;
  const auto close = [&](std::span<const Index> variables, int height) {
    knowledge.pattern.rows.add(variables);
    selected.height.push_back(height);
    selected.begin.push_back(static_cast<Offset>(selected.numbers.size()));
  };
  for (Index r = 0; r < all.rows.size(); ++r) {
    if (r < static_cast<Index>(in.edge.size()) && !in.edge[r]) continue;  // beyond: the gauge's
    selected.numbers.insert(selected.numbers.end(), evidence.block(r), evidence.block(r + 1));
    close(all.rows[r], evidence.height[r]);
  }
  for (Index j = 0; j < all.variables(); ++j) {
    if (in.vertex[evidence.variable_vertex[j]]) continue;
    const int dim = all.dim[j];
    for (int k = 0; k < dim * (dim + 1); ++k)
      selected.numbers.push_back(k < dim * dim && k % (dim + 1) == 0 ? 1 : 0);
    close(std::span(&j, 1), dim);
  }
  selected.pattern = &knowledge.pattern;
}

void draw_signs(boost::random::mt19937& bits, auto&& row) {
  const std::uint32_t word = bits();
  for (int i = 0; i < draws; ++i) row(i) = (word >> i & 1U) != 0 ? 1 : -1;
}

// X and Y: only Y has a lower half.
void draw_responses(Knowledge& knowledge) {
  const Evidence& evidence = knowledge.evidence;
  const Index rows = knowledge.triangle.rows();
  Rows both = Rows::Zero(rows, 2 * draws);
  for (Index j = 0; j < evidence.pattern.variables(); ++j) {
    for (int k = 0; k < evidence.pattern.dim[j]; ++k) {
      const Index row = knowledge.triangle.row(j) + k;
      draw_signs(knowledge.bits, both.row(row).head<draws>());
      if (evidence.position[evidence.step_at[j] + k])
        draw_signs(knowledge.bits, both.row(row).tail<draws>());
    }
  }
  solve::solve_lower(knowledge.triangle, both.rightCols<draws>());
  solve::solve_upper(knowledge.triangle, both);
  knowledge.x = both.leftCols<draws>();
  knowledge.y = both.rightCols<draws>();
}

// U' V of two roots.
MatrixXd inner_product(const Knowledge& knowledge, const Tried& a, const Tried& b) {
  const std::vector<int>& width = knowledge.factor.tree.frontal_dim;
  MatrixXd result = MatrixXd::Zero(a.root.cols(), b.root.cols());
  // From where on both ways to the root are one, and that part's rows.
  auto i = a.path.size(), k = b.path.size();
  Eigen::Index rows = 0;
  for (; i > 0 && k > 0 && a.path[i - 1] == b.path[k - 1]; --i, --k) rows += width[a.path[i - 1]];
  result.noalias() += a.root.bottomRows(rows).transpose() * b.root.bottomRows(rows);
  // What else they share, of several ways each.
  Eigen::Index at = 0, bt = 0;
  for (std::size_t p = 0, q = 0; p < i && q < k;) {
    if (a.path[p] == b.path[q]) {
      const int f = width[a.path[p]];
      result.noalias() += a.root.middleRows(at, f).transpose() * b.root.middleRows(bt, f);
    }
    const bool left = a.path[p] <= b.path[q], right = b.path[q] <= a.path[p];
    if (left) at += width[a.path[p++]];
    if (right) bt += width[b.path[q++]];
  }
  return result;
}

// U (I + C)^-T/2 of all that was added, transposed: for each, what is its own.
Rows whitened_roots(const Knowledge& knowledge) {
  Rows result = Rows::Zero(knowledge.triangle.rows(), knowledge.added_rows);
  for (const Knowledge::Added& added : knowledge.added) {
    Eigen::Index at = 0;
    for (const Index c : added.of.path) {
      const int f = knowledge.factor.tree.frontal_dim[c];
      result.block(knowledge.triangle.first_row[c], added.at, f, added.of.root.cols()) =
          added.of.root.middleRows(at, f);
      at += f;
    }
  }
  MatrixXd factor = MatrixXd::Zero(knowledge.added_rows, knowledge.added_rows);  // of I + C
  for (const Knowledge::Added& added : knowledge.added) {
    const auto h = added.l.rows();
    factor.block(added.at, 0, h, added.at) = added.of.shared.transpose();
    factor.block(added.at, added.at, h, h) = added.l;
  }
  std::vector<bool> reached(knowledge.factor.tree.cliques(), false);
  for (const Knowledge::Added& added : knowledge.added) {
    for (const Index c : added.of.path) reached[c] = true;
  }
  for (Index c = 0; c < knowledge.factor.tree.cliques(); ++c) {
    if (!reached[c]) continue;
    auto rows =
        result.middleRows(knowledge.triangle.first_row[c], knowledge.factor.tree.frontal_dim[c]);
    factor.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(rows);
  }
  return result;
}

}  // namespace

Knowledge start_knowledge(const Evidence& evidence, std::uint64_t seed) {
  Knowledge knowledge{evidence, boost::random::mt19937(static_cast<std::uint32_t>(seed)),
                      {},       {},
                      {},       {},
                      {},       {},
                      {},       {},
                      0,        {}};
  knowledge.variance.assign(evidence.pattern.variables(), 0);
  return knowledge;
}

std::vector<Index> refactor(Knowledge& knowledge, const Selection& in, const graph::Order& order) {
  select_rows(knowledge, in);
  knowledge.added.clear();
  knowledge.added_rows = 0;
  knowledge.factor = solve::plan_elimination(knowledge.selected, order);
  std::vector<Index> undetermined = solve::eliminate(knowledge.factor, knowledge.selected);
  if (!undetermined.empty()) return undetermined;
  knowledge.triangle = solve::triangle(knowledge.factor);
  draw_responses(knowledge);
  return undetermined;
}

void take_variances(Knowledge& knowledge) {
  const Evidence& evidence = knowledge.evidence;
  const std::vector<MatrixXd> covariance = solve::marginal_covariances(knowledge.factor);
  for (Index j = 0; j < evidence.pattern.variables(); ++j) {
    knowledge.variance[j] = 0;
    for (int k = 0; k < evidence.pattern.dim[j]; ++k) {
      if (evidence.position[evidence.step_at[j] + k]) knowledge.variance[j] += covariance[j](k, k);
    }
  }
}

Measurement measurement(const Evidence& evidence, Index r) {
  const auto row = evidence.pattern.rows[r];
  return {{row.begin(), row.end()}, jacobian_of(evidence, r)};
}

Measurement without(const Evidence& evidence, std::span<const Index> rows, Index variable) {
  const graph::Pattern& all = evidence.pattern;
  Measurement result;
  std::vector<Eigen::Index> column_at;  // side by side with its variables
  Eigen::Index height = 0, width = 0;
  for (const Index r : rows) {
    height += evidence.height[r];
    for (const Index j : all.rows[r]) {
      if (j == variable || std::ranges::count(result.variables, j) > 0) continue;
      result.variables.push_back(j);
      column_at.push_back(width);
      width += all.dim[j];
    }
  }
  MatrixXd of_variable = MatrixXd::Zero(height, all.dim[variable]);
  MatrixXd others = MatrixXd::Zero(height, width);
  Eigen::Index at = 0;
  for (const Index r : rows) {
    const auto jacobian = jacobian_of(evidence, r);
    Eigen::Index column = 0;
    for (const Index j : all.rows[r]) {
      const auto part = jacobian.middleCols(column, all.dim[j]);
      if (j == variable) {
        of_variable.middleRows(at, jacobian.rows()) += part;
      } else {
        const auto place = std::ranges::find(result.variables, j) - result.variables.begin();
        others.block(at, column_at[place], jacobian.rows(), all.dim[j]) += part;
      }
      column += all.dim[j];
    }
    at += jacobian.rows();
  }
  Eigen::ColPivHouseholderQR<MatrixXd> qr;
  qr.setThreshold(rank_tolerance);
  qr.compute(of_variable);
  const Eigen::Index rank = qr.rank();
  if (rank < all.dim[variable]) return {};
  others.applyOnTheLeft(qr.householderQ().adjoint());
  result.jacobian = others.bottomRows(height - rank);  // what says nothing of the variable
  return result;
}

namespace {

Gain gain_of(MatrixXd covariance, const Draws& y) {
  covariance.diagonal().array() += 1;
  const Eigen::LLT<MatrixXd> llt(covariance);
  Gain gain{0, 0};
  for (Eigen::Index k = 0; k < covariance.rows(); ++k)
    gain.log_det += 2 * std::log(llt.matrixLLT()(k, k));
  Draws white = y;
  llt.matrixL().solveInPlace(white);
  gain.trace = white.squaredNorm() / draws;
  return gain;
}

}  // namespace

Gain guessed_gain(const Knowledge& knowledge, const Measurement& m) {
  const Draws jx = product(knowledge, m, knowledge.x);
  return gain_of(jx.lazyProduct(jx.transpose()) / draws, product(knowledge, m, knowledge.y));
}

Tried try_measurement(Knowledge& knowledge, const Measurement& m) {
  const solve::Triangle& triangle = knowledge.triangle;
  Tried tried;
  tried.path = solve::path(triangle, m.variables);
  const auto h = m.jacobian.rows();
  const auto size = static_cast<std::size_t>(triangle.rows() * h);
  if (knowledge.work.size() < size) knowledge.work.resize(size, 0);
  Eigen::Map<Rows> x(knowledge.work.data(), triangle.rows(), h);
  Eigen::Index at = 0;
  for (const Index j : m.variables) {
    const int dim = knowledge.evidence.pattern.dim[j];
    x.middleRows(triangle.row(j), dim) = m.jacobian.middleCols(at, dim).transpose();
    at += dim;
  }
  solve::solve_lower(triangle, tried.path, x);
  Eigen::Index rows = 0;
  for (const Index c : tried.path) rows += knowledge.factor.tree.frontal_dim[c];
  tried.root.resize(rows, h);
  rows = 0;
  for (const Index c : tried.path) {
    const int f = knowledge.factor.tree.frontal_dim[c];
    tried.root.middleRows(rows, f) = x.middleRows(triangle.first_row[c], f);
    x.middleRows(triangle.first_row[c], f).setZero();
    rows += f;
  }
  tried.covariance.noalias() = tried.root.transpose() * tried.root;
  tried.y = product(knowledge, m, knowledge.y);
  update(knowledge, tried);
  return tried;
}

void update(const Knowledge& knowledge, Tried& tried) {
  if (tried.known == knowledge.added.size()) return;
  tried.shared.conservativeResize(knowledge.added_rows, tried.root.cols());
  for (; tried.known < knowledge.added.size(); ++tried.known) {
    const Knowledge::Added& added = knowledge.added[tried.known];
    MatrixXd z = inner_product(knowledge, added.of, tried);
    z.noalias() -= added.of.shared.transpose() * tried.shared.topRows(added.at);
    added.l.triangularView<Eigen::Lower>().solveInPlace(z);
    tried.shared.middleRows(added.at, z.rows()) = z;
    tried.covariance.noalias() -= z.transpose() * z;
    tried.y.noalias() -= z.transpose() * added.y;
  }
}

Gain estimated_gain(const Tried& tried) {
  return gain_of(tried.covariance, tried.y);
}

void add(Knowledge& knowledge, Tried tried) {
  MatrixXd information = tried.covariance;
  information.diagonal().array() += 1;
  const MatrixXd l = Eigen::LLT<MatrixXd>(information).matrixL();
  Draws y = tried.y;
  l.triangularView<Eigen::Lower>().solveInPlace(y);
  const auto height = static_cast<Index>(l.rows());
  if (tried.shared.rows() == 0) tried.shared.resize(0, height);
  knowledge.added.push_back({std::move(tried), l, std::move(y), knowledge.added_rows});
  knowledge.added_rows += height;
}

std::vector<Settled> settle(Knowledge& knowledge) {
  const Evidence& evidence = knowledge.evidence;
  std::vector<Settled> result;
  Rows roots = whitened_roots(knowledge);
  std::size_t k = 0;
  while (k < knowledge.added.size()) {  // as many as fit a strip
    const std::size_t first = k;
    const Index begin = knowledge.added[first].at;
    Index end = begin;
    for (; k < knowledge.added.size() && (k == first || end - begin < strip); ++k)
      end = knowledge.added[k].at + static_cast<Index>(knowledge.added[k].l.rows());
    Rows columns = roots.middleCols(begin, end - begin);
    solve::solve_upper(knowledge.triangle, columns);
    for (std::size_t i = first; i < k; ++i) {
      const Knowledge::Added& added = knowledge.added[i];
      Settled settled{{0, 0}, 0};
      for (Eigen::Index row = 0; row < added.l.rows(); ++row)
        settled.gain.log_det += 2 * std::log(added.l(row, row));
      const auto own = columns.middleCols(added.at - begin, added.l.rows());
      for (Index j = 0; j < evidence.pattern.variables(); ++j) {
        for (int s = 0; s < evidence.pattern.dim[j]; ++s) {
          if (!evidence.position[evidence.step_at[j] + s]) continue;
          const double fall = own.row(knowledge.triangle.row(j) + s).squaredNorm();
          knowledge.variance[j] -= fall;
          settled.gain.trace += fall;
        }
      }
      settled.mean_sigma = mean_sigma(knowledge);
      result.push_back(settled);
    }
  }
  return result;
}

double mean_sigma(const Knowledge& knowledge) {
  double sum = 0;
  for (const double variance : knowledge.variance) sum += std::sqrt(std::max(0.0, variance));
  return knowledge.evidence.poses == 0 ? 0 : sum / knowledge.evidence.poses;
}

double total_variance(const Knowledge& knowledge) {
  return std::accumulate(knowledge.variance.begin(), knowledge.variance.end(), 0.0);
}

}  // namespace sg::prune
