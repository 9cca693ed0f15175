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

MatrixXd covariance(Isam2& isam, std::span<const Index> variables) {
  const std::vector<int>& dim = pattern_of(isam).dim;
  int h = 0;
  for (Index j : variables) h += dim[j];
  const int ld = round_up(h);
  std::vector<Index>& path = isam.work.edges;
  path_to_root(isam, variables, path);
  // Right-hand sides by row: those of the path's frontal variables, which are all that it names, clique by clique.
  std::vector<int>& row_at = isam.work.row_at;
  int rows = 0, most = 0;
  for (Index c : path) {
    for (Index j : frontals_of(isam.tree, isam.tree.cliques[c])) {
      row_at[j] = rows;
      rows += dim[j];
    }
    most = std::max(most, isam.tree.cliques[c].s);
  }
  std::vector<double>& numbers = isam.work.rhs;
  numbers.assign(static_cast<std::size_t>(rows + most + h + 1) * ld, 0.0);  // a row of slack
  double* const x = numbers.data();
  double* const above = x + static_cast<std::ptrdiff_t>(rows) * ld;
  double* const minus = above + static_cast<std::ptrdiff_t>(most) * ld;
  const auto rows_of_variable = [&](Index j) {
    return Eigen::Map<Rows>(x + static_cast<std::ptrdiff_t>(row_at[j]) * ld, dim[j], ld);
  };
  Eigen::Index column = 0;
  for (Index j : variables) {
    rows_of_variable(j).middleCols(column, dim[j]).setIdentity();
    column += dim[j];
  }
  for (Index c : path) {
    const Isam2Clique& clique = isam.tree.cliques[c];
    const Front front = front_of(isam.tree, clique);
    double* const u = rows_of_variable(frontals_of(isam.tree, clique).front()).data();
    kernels().solve_lower(front.l, front.ld_l(), u, ld, 0, front.f, h);
    kernels().subtract_product(minus, ld, u, ld, u, ld, h, h, front.f);
    kernels().negative_product(above, ld, u, ld, front.l + front.f, front.ld_l(), h, front.s(),
                               front.f);
    Eigen::Index row = 0;
    for (Index j : separators_of(isam.tree, clique)) {
      rows_of_variable(j) += Eigen::Map<const Rows>(above, front.s(), ld).middleRows(row, dim[j]);
      row += dim[j];
    }
  }
  for (Index c : path) {
    for (Index j : frontals_of(isam.tree, isam.tree.cliques[c])) row_at[j] = -1;
  }
  return -Eigen::Map<const Rows>(minus, h, ld).leftCols(h);
}

MatrixXd covariance(Isam2& isam, Index j) {
  return covariance(isam, std::span(&j, 1));
}

}  // namespace sg::solve
