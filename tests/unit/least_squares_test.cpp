#include "lib/solve/least_squares.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <vector>

#include "tests/unit/common.h"

using namespace sg;
using namespace sg::test;

namespace {

struct Dense {
  Eigen::MatrixXd A, B;
};

// A random problem, and the same as one matrix. A chain of rows determines all variables but the first `free`, which have none.
Dense random_problem(Random& random, int free, solve::LeastSquares& sparse) {
  const int n = static_cast<int>(sparse.at.back()), sides = static_cast<int>(sparse.right.cols());
  const Index variables = sparse.pattern.variables();
  Dense dense{Eigen::MatrixXd(0, n), Eigen::MatrixXd(0, sides)};
  const auto number = [&] { return draw(random, -100, 100) / 50.0; };
  for (int r = 0; r < 3 * variables; ++r) {
    std::vector<Index> own{free + r % (variables - free)};
    const Index other = draw(random, free, variables - 1);
    if (other != own[0]) own.push_back(other);
    int columns = 0;
    for (const Index j : own) columns += sparse.pattern.dim[j];
    const int height = draw(random, 4, 6);
    const Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(height, columns, number);
    const Eigen::MatrixXd B = Eigen::MatrixXd::NullaryExpr(height, sides, number);
    add_row(sparse, own, A, B);
    dense.A.conservativeResizeLike(Eigen::MatrixXd::Zero(dense.A.rows() + height, n));
    dense.B.conservativeResizeLike(Eigen::MatrixXd::Zero(dense.B.rows() + height, sides));
    dense.B.bottomRows(height) = B;
    int column = 0;
    for (const Index j : own) {
      dense.A.block(dense.A.rows() - height, sparse.at[j], height, sparse.pattern.dim[j]) =
          A.middleCols(column, sparse.pattern.dim[j]);
      column += sparse.pattern.dim[j];
    }
  }
  return dense;
}

}  // namespace

TEST_CASE("least squares by blocks are those of dense algebra, what nothing determines is zero",
          "[least_squares]") {
  Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const int variables = draw(random, 2, 12), free = draw(random, 0, 1),
              sides = draw(random, 1, 3);
    std::vector<int> dim(variables);
    for (int& d : dim) d = draw(random, 1, 4);
    solve::LeastSquares sparse = solve::make_least_squares(dim, sides);
    const Dense dense = random_problem(random, free, sparse);
    std::vector<double> damping;
    Eigen::MatrixXd H = dense.A.transpose() * dense.A;
    if (trial % 2 == 1) {
      for (Eigen::Index k = 0; k < H.rows(); ++k) damping.push_back(draw(random, 0, 3));
      H.diagonal() += Eigen::VectorXd::Map(damping.data(), H.rows());
    }
    for (int k = 0; k < sparse.at[free]; ++k) H(k, k) = 1;
    const Eigen::MatrixXd expected = H.llt().solve(dense.A.transpose() * dense.B);

    solve::Elimination elimination = plan_elimination(sparse);
    const solve::Triangle factor = solve::triangle(elimination);
    eliminate(sparse, damping, elimination);
    solve::Rows x = right_side(sparse, factor);
    solve::solve(factor, sides, x);
    for (Index j = 0; j < variables; ++j) {
      const Eigen::MatrixXd own = x.block(factor.row(j), 0, dim[j], sides);
      CHECK((own - expected.middleRows(sparse.at[j], dim[j])).norm() < 1e-6);
    }
  }
}
