#include "lib/solve/isam2_covariance.h"

#include <Eigen/Dense>
#include <algorithm>

namespace sg::solve {

using Eigen::MatrixXd;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

void path_to_root(const Isam2& isam, std::span<const Index> variables, std::vector<Index>& path) {
  path.clear();
  for (Index j : variables) {
    // What this way does not share with those before it goes ahead of them: its last clique is below theirs.
    const auto end = static_cast<std::ptrdiff_t>(path.size());
    for (Index c = isam.tree.variable_clique[j]; c >= 0; c = isam.tree.cliques[c].parent) {
      if (std::find(path.begin(), path.begin() + end, c) != path.begin() + end) break;
      path.push_back(c);
    }
    std::rotate(path.begin(), path.begin() + end, path.end());
  }
}

MatrixXd projected_covariance(Isam2& isam, std::span<const Index> variables,
                              const MatrixXd& jacobian) {
  const std::vector<Index>& at = isam.problem->step_at;
  const std::vector<int>& dim = pattern_of(isam).dim;
  const auto h = static_cast<int>(jacobian.rows());
  const int ld = round_up(h);
  std::vector<double>& numbers = isam.work.rhs;
  numbers.resize(std::max(numbers.size(), static_cast<std::size_t>(at.back()) * ld + lane), 0.0);
  const auto rows_of_variable = [&](Index j) {
    return Eigen::Map<Rows>(numbers.data() + static_cast<std::size_t>(at[j]) * ld, dim[j], ld);
  };
  Eigen::Index column = 0;
  for (Index j : variables) {
    rows_of_variable(j).leftCols(h) += jacobian.middleCols(column, dim[j]).transpose();
    column += dim[j];
  }
  Rows minus = Rows::Zero(h + 1, ld);  // a row of slack
  Rows u, below;
  std::vector<Index>& path = isam.work.edges;
  path_to_root(isam, variables, path);
  for (Index c : path) {
    const Isam2Clique& clique = isam.tree.cliques[c];
    const Front front = front_of(isam.tree, clique);
    if (u.rows() < front.f + 1) u.resize(front.f + 1, ld);
    if (below.rows() < front.s() + 1) below.resize(front.s() + 1, ld);
    Eigen::Index row = 0;
    for (Index j : frontals_of(isam.tree, clique)) {
      u.middleRows(row, dim[j]) = rows_of_variable(j);
      rows_of_variable(j).setZero();
      row += dim[j];
    }
    kernels().solve_lower(front.l, front.ld_l(), u.data(), ld, 0, front.f, h);
    kernels().subtract_product(minus.data(), ld, u.data(), ld, u.data(), ld, h, h, front.f);
    kernels().negative_product(below.data(), ld, u.data(), ld, front.l + front.f, front.ld_l(), h,
                               front.s(), front.f);
    row = 0;
    for (Index j : separators_of(isam.tree, clique)) {
      rows_of_variable(j) += below.middleRows(row, dim[j]);
      row += dim[j];
    }
  }
  return -minus.topLeftCorner(h, h);
}

MatrixXd covariance(Isam2& isam, Index j) {
  const int dim = pattern_of(isam).dim[j];
  return projected_covariance(isam, std::span(&j, 1), MatrixXd::Identity(dim, dim));
}

}  // namespace sg::solve
