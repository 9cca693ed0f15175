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
  const Eigen::Index h = jacobian.rows();
  std::vector<double>& numbers = isam.work.rhs;
  numbers.resize(std::max(numbers.size(), static_cast<std::size_t>(at.back() * h)), 0.0);
  Eigen::Map<Rows> rhs(numbers.data(), at.back(), h);
  Eigen::Index column = 0;
  for (Index j : variables) {
    rhs.middleRows(at[j], dim[j]) += jacobian.middleCols(column, dim[j]).transpose();
    column += dim[j];
  }
  MatrixXd result = MatrixXd::Zero(h, h);
  std::vector<Index>& path = isam.work.edges;
  path_to_root(isam, variables, path);
  for (Index c : path) {
    const Isam2Clique& clique = isam.tree.cliques[c];
    const Front front = front_of(isam.tree, clique);
    const Eigen::Map<const MatrixXd, 0, Eigen::OuterStride<>> l(front.l, front.n, front.f,
                                                                Eigen::OuterStride<>(front.ld_l()));
    MatrixXd u(front.f, h);
    Eigen::Index row = 0;
    for (Index j : frontals_of(isam.tree, clique)) {
      u.middleRows(row, dim[j]) = rhs.middleRows(at[j], dim[j]);
      rhs.middleRows(at[j], dim[j]).setZero();
      row += dim[j];
    }
    l.topRows(front.f).triangularView<Eigen::Lower>().solveInPlace(u);
    result.noalias() += u.transpose() * u;
    for (Index j : separators_of(isam.tree, clique)) {
      rhs.middleRows(at[j], dim[j]).noalias() -= l.middleRows(row, dim[j]) * u;
      row += dim[j];
    }
  }
  return result;
}

MatrixXd covariance(Isam2& isam, Index j) {
  const int dim = pattern_of(isam).dim[j];
  return projected_covariance(isam, std::span(&j, 1), MatrixXd::Identity(dim, dim));
}

}  // namespace sg::solve
