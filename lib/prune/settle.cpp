#include "lib/prune/settle.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace sg::prune {
namespace {

using Eigen::MatrixXd;
using solve::Rows;

// Columns of right-hand sides at a time: memory stays linear.
constexpr Index strip = 64;

// Some rows of a matrix in elimination order.
struct PartialRows {
  std::vector<Index> row;  // of each
  MatrixXd numbers;        // up to a lane
};

// U (I + C)^-T/2 of all that was added, where that is not zero: for each, what is its own.
PartialRows whitened_roots(const Knowledge& knowledge) {
  const std::vector<int>& width = knowledge.factor.tree.frontal_dim;
  std::vector<Index> at(knowledge.factor.tree.cliques(), -1);
  for (const Knowledge::Added& added : knowledge.added) {
    for (const Index c : added.path) at[c] = 0;
  }
  PartialRows result;
  for (Index c = 0; c < knowledge.factor.tree.cliques(); ++c) {
    if (at[c] < 0) continue;
    at[c] = static_cast<Index>(result.row.size());
    for (int k = 0; k < width[c]; ++k) result.row.push_back(knowledge.triangle.first_row[c] + k);
  }
  const auto rows = static_cast<int>(result.row.size());
  result.numbers = MatrixXd::Zero(solve::round_up(rows), knowledge.added_rows);
  for (const Knowledge::Added& added : knowledge.added) {
    Eigen::Index from = 0;
    for (const Index c : added.path) {
      result.numbers.block(at[c], added.at, width[c], added.height) =
          added.root.middleRows(from, width[c]);
      from += width[c];
    }
  }
  solve::kernels().solve_lower(knowledge.l.data(), static_cast<int>(knowledge.l.rows()),
                               result.numbers.data(), static_cast<int>(result.numbers.rows()), 0,
                               knowledge.added_rows, rows);
  return result;
}

// Of some that were added, side by side in these columns of L'^-1 U (I + C)^-1/2.
void settle_strip(Knowledge& knowledge, std::span<const Knowledge::Added> some, const Rows& columns,
                  std::vector<Settled>& result) {
  const Evidence& evidence = knowledge.evidence;
  const std::size_t first = result.size();
  for (const Knowledge::Added& added : some) {
    result.push_back({{0, 0}, 0});
    for (Index row = added.at; row < added.at + added.height; ++row)
      result.back().gain.log_det += 2 * std::log(knowledge.l(row, row));
  }
  const MatrixXd drift = knowledge.drift.transpose() * columns;
  Eigen::Index from = 0;
  for (std::size_t k = 0; k < some.size(); ++k) {
    result[first + k].gain.trace = -drift.middleCols(from, some[k].height).squaredNorm();
    from += some[k].height;
  }
  Eigen::RowVectorXd squares(columns.cols());
  for (Index j = 0; j < evidence.pattern.variables(); ++j) {
    squares.setZero();
    for (int s = 0; s < evidence.pattern.dim[j]; ++s) {
      if (evidence.position[evidence.step_at[j] + s])
        squares += columns.row(knowledge.triangle.row(j) + s).cwiseAbs2();
    }
    Settled* settled = result.data() + first;
    Eigen::Index column = 0;
    for (const Knowledge::Added& added : some) {
      const double fall = squares.segment(column, added.height).sum();
      column += added.height;
      knowledge.variance[j] -= fall;
      settled->gain.trace += fall;
      settled->mean_sigma += std::sqrt(std::max(0.0, knowledge.variance[j])) / evidence.poses;
      ++settled;
    }
  }
}

}  // namespace

std::vector<Settled> settle(Knowledge& knowledge) {
  std::vector<Settled> result;
  const PartialRows roots = whitened_roots(knowledge);
  std::size_t k = 0;
  while (k < knowledge.added.size()) {  // as many as fit a strip
    const std::size_t first = k;
    const Index begin = knowledge.added[first].at;
    Index end = begin;
    for (; k < knowledge.added.size() && (k == first || end - begin < strip); ++k)
      end = knowledge.added[k].at + knowledge.added[k].height;
    Rows columns = Rows::Zero(knowledge.triangle.rows(), solve::round_up(end - begin));
    for (std::size_t row = 0; row < roots.row.size(); ++row)
      columns.row(roots.row[row]).head(end - begin) =
          roots.numbers.row(static_cast<Eigen::Index>(row)).segment(begin, end - begin);
    solve::solve_upper(knowledge.triangle, columns);
    settle_strip(knowledge, std::span(knowledge.added).subspan(first, k - first), columns, result);
  }
  return result;
}

}  // namespace sg::prune
