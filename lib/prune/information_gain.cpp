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
// Of what rows that are in tell of themselves: less than this is left to the others, and they are needed.
constexpr double least_left = 1e-6;

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

// Calls visit(row in elimination order, scalar) for all scalars.
void each_scalar(const Knowledge& knowledge, const auto& visit) {
  const Evidence& evidence = knowledge.evidence;
  for (Index j = 0; j < evidence.pattern.variables(); ++j) {
    for (int k = 0; k < evidence.pattern.dim[j]; ++k)
      visit(knowledge.triangle.row(j) + k, evidence.step_at[j] + k);
  }
}

void place_drift(Knowledge& knowledge) {
  const MatrixXd& drift = knowledge.evidence.drift;
  knowledge.drift.resize(knowledge.triangle.rows(), knowledge.aligned ? drift.cols() : 0);
  if (!knowledge.aligned) return;
  each_scalar(knowledge,
              [&](Index row, Index scalar) { knowledge.drift.row(row) = drift.row(scalar); });
}

// X and Y: only Y has a lower half.
void draw_responses(Knowledge& knowledge) {
  const Evidence& evidence = knowledge.evidence;
  const Index rows = knowledge.triangle.rows();
  Rows both = Rows::Zero(rows, 2 * draws);
  auto y = both.rightCols<draws>();
  each_scalar(knowledge, [&](Index row, Index scalar) {
    draw_signs(knowledge.bits, both.row(row).head<draws>());
    const bool drifts = knowledge.drift.cols() > 0 && !knowledge.drift.row(row).isZero(0);
    if (evidence.position[scalar] || drifts) draw_signs(knowledge.bits, y.row(row));
  });
  if (knowledge.aligned) {
    y -= knowledge.drift * (knowledge.drift.transpose() * y).eval();
    each_scalar(knowledge, [&](Index row, Index scalar) {
      if (!evidence.position[scalar]) y.row(row).setZero();
    });
  }
  solve::solve_lower(knowledge.triangle, both.rightCols<draws>());
  solve::solve_upper(knowledge.triangle, both);
  knowledge.x = both.leftCols<draws>();
  knowledge.y = both.rightCols<draws>();
}

// to += U' V of two roots, by row.
void add_inner_product(const Knowledge& knowledge, const Knowledge::Added& a, const Tried& b,
                       double* to, int stride) {
  const std::vector<int>& width = knowledge.factor.tree.frontal_dim;
  const auto add = [&](Eigen::Index at, Eigen::Index bt, Eigen::Index rows) {
    solve::kernels().add_inner_products(
        to, stride, a.root.data() + at, static_cast<int>(a.root.rows()), a.height,
        b.root.data() + bt, static_cast<int>(b.root.rows()), b.height(), static_cast<int>(rows));
  };
  // From where on both ways to the root are one, and that part's rows.
  auto i = a.path.size(), k = b.path.size();
  int rows = 0;
  for (; i > 0 && k > 0 && a.path[i - 1] == b.path[k - 1]; --i, --k) rows += width[a.path[i - 1]];
  // What else they share, of several ways each.
  Eigen::Index at = 0, bt = 0;
  std::size_t p = 0, q = 0;
  while (p < i && q < k) {
    if (a.path[p] == b.path[q]) add(at, bt, width[a.path[p]]);
    const bool left = a.path[p] <= b.path[q], right = b.path[q] <= a.path[p];
    if (left) at += width[a.path[p++]];
    if (right) bt += width[b.path[q++]];
  }
  for (; p < i; ++p) at += width[a.path[p]];
  for (; q < k; ++q) bt += width[b.path[q]];
  add(at, bt, solve::round_up(rows));  // zeros behind the last
}

}  // namespace

Knowledge start_knowledge(const Evidence& evidence, bool aligned, std::uint64_t seed) {
  Knowledge knowledge{evidence, aligned, boost::random::mt19937(static_cast<std::uint32_t>(seed)),
                      {},       {},      {},
                      {},       {},      {},
                      {},       {},      {},
                      0,        {},      {},
                      {}};
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
  place_drift(knowledge);
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

// information: I + C
Gain gain_of(const MatrixXd& information, const Draws& y) {
  const Eigen::LLT<MatrixXd> llt(information);
  Gain gain{0, 0};
  for (Eigen::Index k = 0; k < information.rows(); ++k)
    gain.log_det += 2 * std::log(llt.matrixLLT()(k, k));
  gain.trace = llt.matrixL().solve(y).squaredNorm() / draws;
  return gain;
}

MatrixXd unit_plus(const MatrixXd& covariance) {
  return MatrixXd::Identity(covariance.rows(), covariance.cols()) + covariance;
}

// U = L^-1 J', on the path.
MatrixXd root_of(Knowledge& knowledge, const Measurement& m, std::span<const Index> path) {
  const solve::Triangle& triangle = knowledge.triangle;
  const auto h = m.jacobian.rows();
  const int stride = solve::round_up(static_cast<int>(h));
  const auto size = static_cast<std::size_t>(triangle.rows()) * stride;
  if (knowledge.work.size() < size) knowledge.work.resize(size, 0);
  Eigen::Map<Rows, 0, Eigen::OuterStride<>> x(knowledge.work.data(), triangle.rows(), h,
                                              Eigen::OuterStride<>(stride));
  Eigen::Index at = 0;
  for (const Index j : m.variables) {
    const int dim = knowledge.evidence.pattern.dim[j];
    x.middleRows(triangle.row(j), dim) = m.jacobian.middleCols(at, dim).transpose();
    at += dim;
  }
  solve::solve_lower(triangle, path, x);
  int rows = 0;
  for (const Index c : path) rows += knowledge.factor.tree.frontal_dim[c];
  MatrixXd root = MatrixXd::Zero(solve::round_up(rows + solve::lane - 1), h);
  rows = 0;
  for (const Index c : path) {
    const int f = knowledge.factor.tree.frontal_dim[c];
    root.middleRows(rows, f) = x.middleRows(triangle.first_row[c], f);
    x.middleRows(triangle.first_row[c], f).setZero();
    rows += f;
  }
  return root;
}

}  // namespace

Gain guessed_gain(const Knowledge& knowledge, const Measurement& m) {
  const Draws jx = product(knowledge, m, knowledge.x);
  return gain_of(unit_plus(jx.lazyProduct(jx.transpose()) / draws),
                 product(knowledge, m, knowledge.y));
}

Tried try_measurement(Knowledge& knowledge, const Measurement& m) {
  Tried tried;
  tried.path = solve::path(knowledge.triangle, m.variables);
  tried.root = root_of(knowledge, m, tried.path);
  tried.y = product(knowledge, m, knowledge.y);
  const int h = tried.height(), ld = static_cast<int>(tried.root.rows());
  tried.covariance = Rows::Zero(h, solve::round_up(h));
  tried.shared.resize(0, solve::round_up(h));
  solve::kernels().add_inner_products(tried.covariance.data(), solve::round_up(h),
                                      tried.root.data(), ld, h, tried.root.data(), ld, h, ld);
  update(knowledge, tried);
  return tried;
}

void update(const Knowledge& knowledge, Tried& tried) {
  if (tried.known == knowledge.added.size()) return;
  const solve::Kernels& kernel = solve::kernels();
  const int h = tried.height(), stride = solve::round_up(h);
  const auto from = static_cast<int>(tried.shared.rows()),
             to = static_cast<int>(knowledge.added_rows);
  tried.shared.conservativeResize(to, stride);
  tried.shared.bottomRows(to - from).setZero();
  for (; tried.known < knowledge.added.size(); ++tried.known) {
    const Knowledge::Added& added = knowledge.added[tried.known];
    if (added.height == 0) continue;
    add_inner_product(knowledge, added, tried, tried.shared.row(added.at).data(), stride);
  }
  kernel.solve_lower(knowledge.l.data(), static_cast<int>(knowledge.l.rows()), tried.shared.data(),
                     stride, from, to, h);
  if (from == to) return;
  const double* const z = tried.shared.row(from).data();
  kernel.subtract_product(tried.covariance.data(), stride, z, stride, z, stride, h, h, to - from);
  kernel.subtract_product(tried.y.data(), draws, knowledge.added_y.row(from).data(), draws, z,
                          stride, draws, h, to - from);
}

Gain estimated_gain(const Tried& tried) {
  return gain_of(unit_plus(tried.covariance.leftCols(tried.height())), tried.y);
}

Gain estimated_loss(const Tried& tried) {
  const int h = tried.height();
  const MatrixXd information =
      unit_plus(-tried.covariance.leftCols(h));  // that the others have of it
  const Eigen::SelfAdjointEigenSolver<MatrixXd> spectrum(information, Eigen::EigenvaluesOnly);
  if (!(spectrum.eigenvalues()(0) > least_left)) return {HUGE_VAL, HUGE_VAL};
  const Gain gain = gain_of(information, tried.y);
  return {gain.trace, -gain.log_det};
}

void add(Knowledge& knowledge, Tried tried) {
  const Index at = knowledge.added_rows, height = tried.height(), end = at + height;
  if (knowledge.l.rows() < end) {
    const Index size = solve::round_up(std::max(end, 2 * at));
    knowledge.l.conservativeResize(size, size);
    knowledge.added_y.conservativeResize(size, draws);
  }
  const MatrixXd information = unit_plus(tried.covariance.leftCols(height));
  knowledge.l.block(at, 0, height, at) = tried.shared.leftCols(height).transpose();
  knowledge.l.block(at, at, height, height) = Eigen::LLT<MatrixXd>(information).matrixL();
  knowledge.added_y.middleRows(at, height) = tried.y;
  if (height > 0)  // a landmark that is just determined adds none
    solve::kernels().solve_lower(&knowledge.l(at, at), static_cast<int>(knowledge.l.rows()),
                                 knowledge.added_y.row(at).data(), draws, 0, height, draws);
  knowledge.added.push_back({std::move(tried.path), std::move(tried.root), at, height});
  knowledge.added_rows = end;
}

double mean_sigma(const Knowledge& knowledge) {
  double sum = 0;
  for (const double variance : knowledge.variance) sum += std::sqrt(std::max(0.0, variance));
  return knowledge.evidence.poses == 0 ? 0 : sum / knowledge.evidence.poses;
}

double total_variance(const Knowledge& knowledge) {
  const double sum = std::accumulate(knowledge.variance.begin(), knowledge.variance.end(), 0.0);
  if (!knowledge.aligned) return sum;
  const Eigen::Index motions = knowledge.drift.cols();
  Rows moved = Rows::Zero(knowledge.triangle.rows(), solve::round_up(static_cast<int>(motions)));
  each_scalar(knowledge, [&](Index row, Index scalar) {
    if (knowledge.evidence.position[scalar])
      moved.row(row).head(motions) = knowledge.drift.row(row);
  });
  solve::solve_lower(knowledge.triangle, moved);
  return sum - moved.squaredNorm();
}

}  // namespace sg::prune
