// The multifrontal elimination against dense algebra, and its cliques against lib/elim's.
#include "lib/solve/eliminate.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <Eigen/Dense>
#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>

#include "formats/formats.h"
#include "lib/elim/score.h"
#include "lib/factor/initialize.h"
#include "lib/order/order.h"
#include "lib/solve/factorize.h"
#include "lib/solve/linear_solver.h"
#include "lib/solve/marginals.h"
#include "tests/unit/common.h"

using namespace sg::test;

namespace {

struct System {
  sg::graph::Pattern pattern;
  sg::factor::LinearSystem linear;
};

void add_row(System& system, int height, const std::vector<sg::Index>& variables, Random& random) {
  if (system.linear.begin.empty()) system.linear.begin.push_back(0);
  int width = 1;
  for (sg::Index j : variables) width += system.pattern.dim[j];
  system.pattern.rows.add(variables);
  system.linear.height.push_back(height);
  for (int k = 0; k < height * width; ++k) system.linear.numbers.push_back(uniform(random, -1, 1));
  system.linear.begin.push_back(static_cast<sg::Offset>(system.linear.numbers.size()));
}

// Several components, repeated rows, rows of one to four variables in any order; every variable has
// a prior unless it is in `loose`.
System random_system(Random& random, int variables, int rows,
                     const std::vector<sg::Index>& loose = {}) {
  System system;
  for (int j = 0; j < variables; ++j) system.pattern.dim.push_back(draw(random, 1, 7));
  for (int j = 0; j < variables; ++j) {
    if (std::find(loose.begin(), loose.end(), j) == loose.end())
      add_row(system, system.pattern.dim[j] + draw(random, 0, 1), {j}, random);
  }
  for (int r = 0; r < rows; ++r) {
    std::vector<sg::Index> row;
    const int at = draw(random, 0, variables - 1);
    for (int k = draw(random, 1, 4); k > 0; --k) {
      const int j = std::clamp(at + draw(random, -4, 4), 0, variables - 1);
      const bool taken = std::find(row.begin(), row.end(), j) != row.end() ||
                         std::find(loose.begin(), loose.end(), j) != loose.end();
      if (!taken) row.push_back(j);
    }
    if (!row.empty()) add_row(system, draw(random, 1, 6), row, random);
  }
  return system;
}

struct Dense {
  Eigen::MatrixXd a;
  Eigen::VectorXd b;
};

Dense dense(const System& system) {
  std::vector<int> at{0};
  for (int dim : system.pattern.dim) at.push_back(at.back() + dim);
  int rows = 0;
  for (int height : system.linear.height) rows += height;
  Dense result{Eigen::MatrixXd::Zero(rows, at.back()), Eigen::VectorXd::Zero(rows)};
  int row = 0;
  for (sg::Index r = 0; r < system.pattern.rows.size(); ++r) {
    const int height = system.linear.height[r];
    const double* column = system.linear.block(r);
    for (sg::Index j : system.pattern.rows[r]) {
      for (int k = 0; k < system.pattern.dim[j]; ++k, column += height)
        result.a.block(row, at[j] + k, height, 1) =
            Eigen::Map<const Eigen::VectorXd>(column, height);
    }
    result.b.segment(row, height) = Eigen::Map<const Eigen::VectorXd>(column, height);
    row += height;
  }
  return result;
}

Eigen::Map<const Eigen::VectorXd> as_vector(const std::vector<double>& step) {
  return {step.data(), static_cast<Eigen::Index>(step.size())};
}

// A front with a positive definite matrix, and that matrix in full.
struct DenseFront {
  std::vector<double> l, u;
  sg::solve::Front front;
  Eigen::MatrixXd full;

  DenseFront(Random& random, int f, int s) : front{nullptr, nullptr, f, f + s + 1} {
    l.assign(front.size_l() + sg::solve::lane, 0);
    u.assign(front.size_u() + sg::solve::lane, 0);
    front.l = l.data();
    front.u = u.data();
    const Eigen::MatrixXd root = Eigen::MatrixXd::NullaryExpr(
        front.n + 2, front.n, [&](Eigen::Index, Eigen::Index) { return uniform(random, -1, 1); });
    full = root.transpose() * root;
  }
  double& at(int i, int j) {
    if (j < front.f) return l[j * front.ld_l() + i];
    return u[(j - front.f) * front.ld_u() + i - front.f];
  }
};

}  // namespace

TEST_CASE("kernels of every instruction set do dense partial Cholesky", "[eliminate]") {
  Random random(1);
  for (const sg::solve::Kernels* kernel : sg::solve::all_kernels()) {
    INFO(kernel->name);
    for (int f = 1; f < 30; f += 1 + f / 8) {
      for (int s = 0; s < 60; s += 1 + s / 3) {
        DenseFront dense(random, f, s);
        const int n = dense.front.n;
        std::fill(dense.l.begin(), dense.l.end(), 7.0);
        std::fill(dense.u.begin(), dense.u.end(), 7.0);
        kernel->clear(dense.front);
        const sg::solve::Run all[] = {{0, 0, n / 2}, {n / 2, n / 2, n - n / 2}};
        kernel->add(dense.front, dense.full.data(), n, all, 2);
        const std::vector<double> floor(f, 1e-9);
        REQUIRE(kernel->factorize(dense.front, floor.data()) == 0);

        const Eigen::MatrixXd l11 = dense.full.topLeftCorner(f, f).llt().matrixL();
        const Eigen::MatrixXd l21 = l11.triangularView<Eigen::Lower>()
                                        .solve(dense.full.bottomLeftCorner(n - f, f).transpose())
                                        .transpose();
        Eigen::MatrixXd expected = dense.full;
        expected.topLeftCorner(f, f) = l11;
        expected.bottomLeftCorner(n - f, f) = l21;
        expected.bottomRightCorner(n - f, n - f) -= l21 * l21.transpose();
        double worst = 0;
        for (int j = 0; j < n; ++j) {
          for (int i = j; i < n; ++i)
            worst = std::max(worst, std::abs(dense.at(i, j) - expected(i, j)));
        }
        CHECK(worst < 1e-7);
        Eigen::MatrixXd root = Eigen::MatrixXd::Constant(sg::solve::round_up(f), f, 7.0);
        kernel->invert(dense.front, root.data());
        const Eigen::MatrixXd identity = root.topRows(f).transpose() * l11;
        CHECK((identity - Eigen::MatrixXd::Identity(f, f)).norm() < 1e-7);
        CHECK(root.topRows(f).isUpperTriangular(0));
      }
    }
  }
}

TEST_CASE("kernels: by panels of any width, by any number of threads, the bytes are the same",
          "[eliminate][parallel]") {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
  Random random(7);
  for (const sg::solve::Kernels* kernel : sg::solve::all_kernels()) {
    for (const int f : {1, 2, 3, 31, 33, 64, 257}) {
      for (const int s : {0, 1, 2, 31, 33, 257}) {
        INFO(kernel->name << ", " << f << " frontals, separator " << s);
        DenseFront dense(random, f, s);
        const int n = dense.front.n;
        const sg::solve::Run all{0, 0, n};
        const std::vector<double> floor(f, 1e-9);
        const auto fill = [&] {
          kernel->clear(dense.front);
          kernel->add(dense.front, dense.full.data(), n, &all, 1);
        };
        const auto lower = [&] {
          std::vector<double> numbers;
          for (int j = 0; j < n; ++j) {
            for (int i = j; i < n; ++i) numbers.push_back(dense.at(i, j));
          }
          return numbers;
        };
        fill();
        REQUIRE(kernel->factorize(dense.front, floor.data()) == 0);
        const std::vector<double> expected = lower();
        for (const int width : {4, 32, 128}) {
          for (const int threads : {1, 3}) {
            std::vector<double> work(sg::solve::panel_work(*kernel, n, width));
            fill();
            int dropped = -1;
            tbb::task_arena(threads).execute([&] {
              dropped = sg::solve::factorize_by_panels(*kernel, dense.front, floor.data(),
                                                       work.data(), threads, width);
            });
            REQUIRE(dropped == 0);
            const bool same = lower() == expected;
            CHECK(same);
          }
        }
      }
    }
  }
}

TEST_CASE("kernels: a pivot is dropped by panels as by columns", "[eliminate]") {
  Random random(8);
  for (const sg::solve::Kernels* kernel : sg::solve::all_kernels()) {
    INFO(kernel->name);
    DenseFront dense(random, 40, 20);
    const int n = dense.front.n;
    for (const int gone : {5, 6, 37}) {  // twice the column before
      dense.full.col(gone) = 2 * dense.full.col(gone - 1);
      dense.full.row(gone) = 2 * dense.full.row(gone - 1);
    }
    const sg::solve::Run all{0, 0, n};
    const std::vector<double> floor(40, 1e-9);
    std::vector<double> work(sg::solve::panel_work(*kernel, n, 8)), l;
    for (const bool panels : {false, true}) {
      kernel->clear(dense.front);
      kernel->add(dense.front, dense.full.data(), n, &all, 1);
      const int dropped = panels ? sg::solve::factorize_by_panels(*kernel, dense.front,
                                                                  floor.data(), work.data(), 1, 8)
                                 : kernel->factorize(dense.front, floor.data());
      CHECK(dropped == 3);
      std::vector<double> bottom;  // row of the right-hand side
      for (int j = 0; j < n; ++j) bottom.push_back(dense.at(n - 1, j));
      if (!panels) l = bottom;
      CHECK(bottom == l);
    }
  }
}

TEST_CASE(
    "kernels: a square taken from a front, its rows in any order, and a front without an update",
    "[eliminate]") {
  for (const sg::solve::Kernels* kernel : sg::solve::all_kernels()) {
    INFO(kernel->name);
    for (int trial = 0; trial < 200; ++trial) {
      Random random(trial);
      const int depth = draw(random, 1, 9);
      DenseFront dense(random, draw(random, 1, 40), draw(random, 0, 60));
      const int n = dense.front.n;
      std::vector<sg::solve::Run> runs;  // of some rows of the front, from rows in another order
      for (int to = draw(random, 0, 3); to < n;) {
        const int length = std::min(draw(random, 1, 20), n - to);
        runs.push_back({0, to, length});
        to += length + draw(random, 0, 5);
      }
      const std::vector<sg::Index> order = shuffled(random, static_cast<sg::Index>(runs.size()));
      int height = 0;
      for (const sg::Index k : order) {
        runs[k].from = height;
        height += runs[k].length;
      }
      if (runs.empty()) continue;
      const int ld = sg::solve::round_up(height);
      const Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(
          ld, depth, [&](Eigen::Index, Eigen::Index) { return uniform(random, -1, 1); });
      Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(n, depth);
      for (const sg::solve::Run& run : runs)
        spread.middleRows(run.to, run.length) = a.middleRows(run.from, run.length);
      const Eigen::MatrixXd expected = dense.full - spread * spread.transpose();

      const bool formed = trial % 2 == 0;
      if (!formed) dense.front.u = nullptr;
      std::fill(dense.u.begin(), dense.u.end(), 7.0);
      const sg::solve::Run all{0, 0, n};
      kernel->clear(dense.front);
      kernel->add(dense.front, dense.full.data(), n, &all, 1);
      kernel->subtract_square(dense.front, a.data(), ld, depth, runs.data(),
                              static_cast<int>(runs.size()));
      double worst = 0;
      for (int j = 0; j < (formed ? n : dense.front.f); ++j) {
        for (int i = j; i < n; ++i)
          worst = std::max(worst, std::abs(dense.at(i, j) - expected(i, j)));
      }
      CHECK(worst < 1e-10);
      if (formed) continue;
      const std::vector<double> floor(dense.front.f, -1e9);
      kernel->factorize(dense.front, floor.data());
      CHECK(std::ranges::count(dense.u, 7.0) == static_cast<std::ptrdiff_t>(dense.u.size()));
    }
  }
}

TEST_CASE("kernels: a product, whatever lies behind its last rows", "[eliminate]") {
  Random random(3);
  const auto padded = [&](int rows, int columns) {
    return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(
        sg::solve::round_up(rows), columns,
        [&](Eigen::Index, Eigen::Index) { return uniform(random, -1, 1); }));
  };
  for (const sg::solve::Kernels* kernel : sg::solve::all_kernels()) {
    INFO(kernel->name);
    for (int rows = 1; rows < 80; rows += 1 + rows / 3) {
      for (int columns = 1; columns < 20; columns += 1 + columns / 4) {
        const int depth = draw(random, 1, 30);
        const Eigen::MatrixXd a = padded(rows, depth), b = padded(columns, depth);
        Eigen::MatrixXd c = padded(rows, columns);
        const auto ld = [](const Eigen::MatrixXd& m) { return static_cast<int>(m.rows()); };
        kernel->negative_product(c.data(), ld(c), a.data(), ld(a), b.data(), ld(b), rows, columns,
                                 depth);
        const Eigen::MatrixXd expected = -a.topRows(rows) * b.topRows(columns).transpose();
        CHECK((c.topRows(rows) - expected).norm() < 1e-12 * (1 + expected.norm()));
      }
    }
  }
}

TEST_CASE("kernels: solves of many right-hand sides by row, and products of columns",
          "[eliminate]") {
  Random random(5);
  const auto any = [&](int rows, int columns) {
    return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(
        rows, columns, [&](Eigen::Index, Eigen::Index) { return uniform(random, -1, 1); }));
  };
  for (const sg::solve::Kernels* kernel : sg::solve::all_kernels()) {
    INFO(kernel->name);
    for (int trial = 0; trial < 60; ++trial) {
      const int f = draw(random, 1, 30), n = f + 1 + draw(random, 0, 30);
      const int columns = draw(random, 1, 70), ldx = sg::solve::round_up(columns);
      INFO("f " << f << ", n " << n << ", columns " << columns);
      DenseFront dense(random, f, n - f - 1);
      const sg::solve::Run all[] = {{0, 0, n}};
      kernel->clear(dense.front);
      kernel->add(dense.front, dense.full.data(), n, all, 1);
      const std::vector<double> floor(f, 1e-9);
      REQUIRE(kernel->factorize(dense.front, floor.data()) == 0);
      Eigen::MatrixXd l11 = Eigen::MatrixXd::Zero(f, f), l21(n - 1 - f, f);
      for (int j = 0; j < f; ++j) {
        for (int i = j; i < n - 1; ++i) (i < f ? l11(i, j) : l21(i - f, j)) = dense.at(i, j);
      }
      // By row: a matrix by column of as many rows as there are right-hand sides.
      const Eigen::MatrixXd given = any(ldx, f), above = any(ldx, n - 1 - f);
      const auto sides = [&](const Eigen::MatrixXd& m) {
        return Eigen::MatrixXd(m.topRows(columns).transpose());
      };
      Eigen::MatrixXd x = given;
      const int half = draw(random, 0, f);
      kernel->solve_lower(dense.front.l, dense.front.ld_l(), x.data(), ldx, 0, half, columns);
      kernel->solve_lower(dense.front.l, dense.front.ld_l(), x.data(), ldx, half, f, columns);
      CHECK((l11 * sides(x) - sides(given)).norm() < 1e-9 * (1 + sides(x).norm()));
      x = given;
      kernel->solve_upper(dense.front, x.data(), ldx, above.data(), columns);
      CHECK((l11.transpose() * sides(x) + l21.transpose() * sides(above) - sides(given)).norm() <
            1e-9 * (1 + sides(x).norm() + sides(above).norm()));

      const int rows = draw(random, 1, 50), depth = draw(random, 1, 9);
      const Eigen::MatrixXd a = any(ldx, depth), b = any(sg::solve::round_up(rows), depth);
      Eigen::MatrixXd c = any(ldx, rows);
      const Eigen::MatrixXd less =
          c.topRows(columns) - a.topRows(columns) * b.topRows(rows).transpose();
      kernel->subtract_product(c.data(), ldx, a.data(), ldx, b.data(), sg::solve::round_up(rows),
                               columns, rows, depth);
      CHECK((c.topRows(columns) - less).norm() < 1e-12 * (1 + less.norm()));

      const int left = draw(random, 1, 9), right = draw(random, 1, 9);
      const Eigen::MatrixXd u = any(rows, left), v = any(rows + 2, right);
      Eigen::MatrixXd sums = any(right + 1, left);  // by row
      const Eigen::MatrixXd more = sums.topRows(right) + v.topRows(rows).transpose() * u;
      kernel->add_inner_products(sums.data(), right + 1, u.data(), rows, left, v.data(), rows + 2,
                                 right, rows);
      CHECK((sums.topRows(right) - more).norm() < 1e-12 * (1 + more.norm()));
    }
  }
}

TEST_CASE("kernels: Gram matrix and scattered sum, in either order", "[eliminate]") {
  Random random(2);
  for (const sg::solve::Kernels* kernel : sg::solve::all_kernels()) {
    INFO(kernel->name);
    for (int height = 1; height < 9; ++height) {
      for (int width = 3; width < 25; ++width) {
        const Eigen::MatrixXd block = Eigen::MatrixXd::NullaryExpr(
            height, width, [&](Eigen::Index, Eigen::Index) { return uniform(random, -1, 1); });
        std::vector<double> gram(width * width + sg::solve::lane);
        std::vector<double> work(height * (width + sg::solve::lane));
        kernel->gram(block.data(), height, width, gram.data(), work.data());
        const Eigen::MatrixXd expected = block.transpose() * block;
        CHECK((Eigen::Map<Eigen::MatrixXd>(gram.data(), width, width) - expected).norm() < 1e-12);

        DenseFront dense(random, 4, width + 3);
        kernel->clear(dense.front);
        const int last = dense.front.n - 1;
        const sg::solve::Run runs[] = {{1, 2, width - 2}, {0, width + 1, 1}, {width - 1, last, 1}};
        kernel->add(dense.front, gram.data(), width, runs, 3);
        for (const sg::solve::Run& a : runs) {
          for (const sg::solve::Run& b : runs) {
            for (int i = 0; i < a.length; ++i) {
              for (int j = 0; j < b.length; ++j) {
                if (a.to + i < b.to + j) continue;
                CHECK(dense.at(a.to + i, b.to + j) == Approx(expected(a.from + i, b.from + j)));
              }
            }
          }
        }
      }
    }
  }
}

TEST_CASE("kernels: a front set to a matrix is one that is cleared and added to, bit for bit",
          "[eliminate]") {
  Random random(8);
  for (const sg::solve::Kernels* kernel : sg::solve::all_kernels()) {
    INFO(kernel->name);
    for (int trial = 0; trial < 300; ++trial) {
      const int f = draw(random, 1, 20), s = draw(random, 0, 40);
      DenseFront set(random, f, s), added(random, f, s);
      const int n = set.front.n;
      if (trial % 4 == 0) set.front.u = added.front.u = nullptr;
      std::vector<sg::solve::Run> runs;  // ascending in `to`; the last one is the right-hand side
      int from = 0;
      for (int to = draw(random, 0, 5); to + 1 < n; to += draw(random, 1, 9)) {
        const int length = std::min(draw(random, 1, 12), n - 1 - to);
        runs.push_back({from, to, length});
        from += length;
        to += length;
      }
      runs.push_back({from, n - 1, 1});
      const int size = from + 1;
      if (runs.size() > 2 && trial % 3 == 0) {  // ordered anew: two of one length change places
        for (sg::solve::Run& run : std::span(runs).first(runs.size() - 1)) run.length = 1;
        std::swap(runs[0].from, runs[1].from);
      }
      Eigen::MatrixXd matrix = Eigen::MatrixXd::NullaryExpr(
          sg::solve::round_up(size) + sg::solve::lane, size + sg::solve::lane,
          [&](Eigen::Index, Eigen::Index) { return uniform(random, -1, 1); });
      const auto ld = static_cast<int>(matrix.rows());
      const auto count = static_cast<int>(runs.size());
      std::ranges::fill(set.l, 7.0);
      std::ranges::fill(set.u, 7.0);
      kernel->set(set.front, matrix.data(), ld, runs.data(), count);
      kernel->clear(added.front);
      kernel->add(added.front, matrix.data(), ld, runs.data(), count);
      bool same = true;
      for (int j = 0; j < (set.front.u ? n : f); ++j) {
        for (int i = j; i < n; ++i) same &= set.at(i, j) == added.at(i, j);
      }
      CHECK(same);
      // Nothing is written behind the pieces.
      for (int k = 0; k < sg::solve::lane; ++k) {
        CHECK(set.l[set.front.size_l() + k] == 7);
        CHECK(set.u[set.front.size_u() + k] == 7);
      }
    }
  }
}

TEST_CASE("elimination solves random systems as dense algebra does", "[eliminate]") {
  Random random(3);
  std::ptrdiff_t factors = 0;  // cliques without an update
  for (int trial = 0; trial < 200; ++trial) {
    const int n = draw(random, 1, 40);
    System system = random_system(random, n, draw(random, 0, 3 * n));
    system.linear.pattern = &system.pattern;
    const Dense full = dense(system);
    std::vector<double> damping;
    Eigen::MatrixXd normal = full.a.transpose() * full.a;
    if (trial % 2 == 1) {
      for (Eigen::Index k = 0; k < normal.rows(); ++k) damping.push_back(0.1 + 0.01 * (k % 5));
      normal.diagonal() += as_vector(damping);
    }
    const Eigen::LDLT<Eigen::MatrixXd> solver(normal);
    const Eigen::VectorXd expected = solver.solve(full.a.transpose() * full.b);

    const int threads = 1 + trial % 3;
    auto elimination = sg::solve::plan_elimination(system.linear, shuffled(random, n), threads);
    factors += std::ranges::count(elimination.u_at, -1);
    std::vector<double> step;
    for (int again = 0; again < 2; ++again) {
      REQUIRE(sg::solve::eliminate(elimination, system.linear, damping).empty());
      sg::solve::back_substitute(elimination, step);
      const double tolerance = 1e-12 / std::max(solver.rcond(), 1e-11);
      CHECK((as_vector(step) - expected).norm() <= tolerance * (1 + expected.norm()));
      const double log_determinant = solver.vectorD().array().log().sum();
      CHECK(sg::solve::log_determinant(elimination) == Approx(log_determinant).margin(1e-6));
    }
  }
  CHECK(factors > 20);
}

TEST_CASE("a front that is worked through by panels and in parallel solves its system",
          "[eliminate][parallel]") {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
  Random random(9);
  System system;
  const int n = 200;
  system.pattern.dim.assign(n, 6);
  std::vector<sg::Index> all(n);
  std::iota(all.begin(), all.end(), 0);
  for (sg::Index j : all) add_row(system, 7, {j}, random);
  add_row(system, 3, all, random);
  system.linear.pattern = &system.pattern;
  const Dense full = dense(system);
  std::vector<double> first, step;
  for (const int threads : {1, 2, 3}) {
    auto elimination = sg::solve::plan_elimination(system.linear, all, threads);
    REQUIRE(elimination.tree.cliques() == 1);
    REQUIRE(sg::solve::factorization_work(sg::solve::kernels(), 6 * n, 6 * n + 1) > 0);
    REQUIRE(sg::solve::eliminate(elimination, system.linear).empty());
    sg::solve::back_substitute(elimination, step);
    if (first.empty()) first = step;
    CHECK(step == first);
  }
  const Eigen::VectorXd gradient = full.a.transpose() * (full.a * as_vector(step) - full.b);
  CHECK(gradient.norm() < 1e-9);
}

TEST_CASE("undetermined variables are named, the others solved", "[eliminate]") {
  Random random(4);
  for (int trial = 0; trial < 50; ++trial) {
    const int n = draw(random, 3, 20);
    const sg::Index loose = draw(random, 0, n - 1);
    System system = random_system(random, n, 2 * n, {loose});
    system.linear.pattern = &system.pattern;
    auto elimination = sg::solve::plan_elimination(system.linear, shuffled(random, n));
    CHECK(sg::solve::eliminate(elimination, system.linear) == std::vector<sg::Index>{loose});
    std::vector<double> step;
    sg::solve::back_substitute(elimination, step);
    const Dense full = dense(system);
    const Eigen::VectorXd gradient = full.a.transpose() * (full.a * as_vector(step) - full.b);
    CHECK(gradient.norm() < 1e-6);
  }
}

TEST_CASE("CHOLMOD finds the step or a vanished pivot by either of its factorizations",
          "[eliminate]") {
  Random random(7);
  int supernodal = 0;
  for (int trial = 0; trial < 24; ++trial) {
    const int n = trial % 2 == 0 ? draw(random, 3, 20) : 120;
    std::vector<sg::Index> loose;
    if (trial % 3 == 0) loose.push_back(draw(random, 0, n - 1));
    System system = random_system(random, n, 8 * n, loose);
    system.linear.pattern = &system.pattern;
    const sg::graph::Order order = shuffled(random, n);
    const auto score = sg::elim::score(sg::elim::symbolic(system.pattern, order));
    supernodal += score.flops >= 40 * score.nnz ? 1 : 0;  // its own rule
    const auto solver = sg::solve::cholmod_solver(system.linear, order, 1);
    REQUIRE(solver.eliminate(system.linear, {}) == loose.empty());
    if (!loose.empty()) continue;
    std::vector<double> step;
    solver.back_substitute(step);
    const Dense full = dense(system);
    const Eigen::VectorXd gradient = full.a.transpose() * (full.a * as_vector(step) - full.b);
    CHECK(gradient.norm() < 1e-6);
  }
  CHECK(supernodal == 12);
}

TEST_CASE("a chain that nothing anchors misses as many variables as it is free", "[eliminate]") {
  System system;
  const int n = 300;
  Random random(5);
  system.pattern.dim.assign(n, 2);
  for (int j = 0; j + 1 < n; ++j) {
    add_row(system, 2, {j, j + 1}, random);
    double* const block = system.linear.block(j);
    const double numbers[] = {1, 0.3, 0, 2, -1, -0.3, 0, -2, 0.5, 0.25};
    std::copy_n(numbers, 10, block);
  }
  system.linear.pattern = &system.pattern;
  const sg::graph::Order order = shuffled(random, n);
  auto elimination = sg::solve::plan_elimination(system.linear, order);
  CHECK(sg::solve::eliminate(elimination, system.linear).size() == 1);
  CHECK(!sg::solve::cholmod_solver(system.linear, order, 1).eliminate(system.linear, {}));
  add_row(system, 2, {n / 2}, random);
  system.linear.pattern = &system.pattern;
  elimination = sg::solve::plan_elimination(system.linear, order);
  CHECK(sg::solve::eliminate(elimination, system.linear).empty());
  CHECK(sg::solve::cholmod_solver(system.linear, order, 1).eliminate(system.linear, {}));
}

TEST_CASE("cliques: unrelaxed they are lib/elim's, relaxed they keep its EC_BT", "[eliminate]") {
  Random random(6);
  for (int trial = 0; trial < 100; ++trial) {
    const int n = draw(random, 1, 50);
    const System system = random_system(random, n, draw(random, 0, 3 * n));
    const sg::graph::Order order = shuffled(random, n);
    const sg::elim::Score score = sg::elim::score(sg::elim::symbolic(system.pattern, order));
    for (const bool relaxed : {false, true}) {
      const sg::solve::CliqueTree tree =
          sg::solve::clique_tree(system.pattern, order, relaxed ? 0 : sg::solve::never);
      sg::elim::Wide ec_bt = 0;
      for (std::int64_t ec : tree.ec) ec_bt += ec;
      CHECK(ec_bt == score.ec_bt);
      CHECK(tree.cliques() <= score.cliques);
      if (!relaxed) CHECK(tree.cliques() == score.cliques);
      CHECK(std::accumulate(tree.merged.begin(), tree.merged.end(), 0) == score.cliques);
      // What a clique passes on lies within its parent.
      for (sg::Index c = 0; c < tree.cliques(); ++c) {
        CHECK((tree.separators[c].empty()) == (tree.parent[c] < 0));
        if (tree.parent[c] < 0) continue;
        const auto f = tree.frontals[tree.parent[c]], s = tree.separators[tree.parent[c]];
        for (sg::Index j : tree.separators[c]) {
          const bool found = std::find(f.begin(), f.end(), j) != f.end() ||
                             std::find(s.begin(), s.end(), j) != s.end();
          CHECK(found);
        }
      }
      // Renumbered, the elimination costs the same.
      CHECK(sg::elim::elimination_complexity(system.pattern, tree.frontals.items) == score.ec);
    }
  }
}

TEST_CASE("small cliques join their parents, where one front takes less time than two",
          "[eliminate]") {
  std::vector<std::vector<sg::Index>> rows;
  for (sg::Index j = 1; j < 100; ++j) rows.push_back({j - 1, j});
  const sg::graph::Pattern chain = make_pattern(std::vector<int>(100, 3), rows);
  sg::graph::Order order(100);
  std::iota(order.begin(), order.end(), 0);
  CHECK(sg::solve::clique_tree(chain, order, sg::solve::never).cliques() == 99);
  CHECK(sg::solve::clique_tree(chain, order).cliques() < 50);
}

TEST_CASE("public graphs: the step makes the gradient vanish", "[eliminate]") {
  const auto folder = public_graphs();
  if (!folder) return;
  for (const char* name : {"tinyGrid3D.g2o", "smallGrid3D.g2o", "intel.g2o", "sphere2500.g2o",
                           "victoriaPark.isam.txt"}) {
    INFO(name);
    const sg::Graph graph = sg::formats::read_graph(*folder + "/" + name);
    const sg::factor::Problem problem = sg::factor::make_problem(graph);
    sg::factor::LinearSystem system = sg::factor::make_linear_system(problem);
    sg::factor::linearize(problem, sg::factor::start_values(problem), {}, system);
    const sg::graph::Order order = sg::order::elimination_order("colamd", *system.pattern);
    auto elimination = sg::solve::plan_elimination(system, order);
    std::vector<double> step, gradient, threaded;
    REQUIRE(sg::solve::eliminate(elimination, system).empty());
    sg::solve::back_substitute(elimination, step);
    gradient.assign(step.size(), 0);
    double scale = 0;
    for (sg::Index r = 0; r < system.pattern->rows.size(); ++r) {
      const int height = system.height[r];
      const auto column = [&](int k) {
        return Eigen::Map<const Eigen::VectorXd>(system.block(r) + k * height, height);
      };
      int k = 0;
      Eigen::VectorXd error = Eigen::VectorXd::Zero(height);
      for (sg::Index j : system.pattern->rows[r]) {
        for (int i = 0; i < system.pattern->dim[j]; ++i)
          error += column(k++) * step[problem.step_at[j] + i];
      }
      error -= column(k);
      k = 0;
      for (sg::Index j : system.pattern->rows[r]) {
        for (int i = 0; i < system.pattern->dim[j]; ++i, ++k) {
          gradient[problem.step_at[j] + i] += column(k).dot(error);
          scale = std::max(scale, column(k).norm() * error.norm());
        }
      }
    }
    CHECK(as_vector(gradient).lpNorm<Eigen::Infinity>() < 1e-8 * (1 + scale));

    auto parallel = sg::solve::plan_elimination(system, order, 2);
    REQUIRE(sg::solve::eliminate(parallel, system).empty());
    sg::solve::back_substitute(parallel, threaded);
    CHECK(threaded == step);
  }
}

TEST_CASE("marginal covariances are blocks of the dense inverse", "[eliminate]") {
  for (int trial = 0; trial < 100; ++trial) {
    Random random(100 + trial);
    const int n = draw(random, 1, 40);
    System system = random_system(random, n, draw(random, 0, 3 * n));
    system.linear.pattern = &system.pattern;
    const Dense full = dense(system);
    const Eigen::MatrixXd inverse = (full.a.transpose() * full.a).inverse();
    auto elimination = sg::solve::plan_elimination(system.linear, shuffled(random, n));
    REQUIRE(sg::solve::eliminate(elimination, system.linear).empty());
    const auto blocks = sg::solve::marginal_covariances(elimination);
    double worst = 0;
    for (int j = 0; j < n; ++j) {
      const int at = elimination.step_at[j], dim = system.pattern.dim[j];
      worst = std::max(worst, (blocks[j] - inverse.block(at, at, dim, dim)).norm());
    }
    CHECK(worst < 1e-9 * inverse.norm());
    std::vector<sg::Index> some;
    for (int k = draw(random, 1, 4); k > 0; --k) some.push_back(draw(random, 0, n - 1));
    std::vector<int> rows;
    for (const sg::Index j : some) {
      for (int k = 0; k < system.pattern.dim[j]; ++k) rows.push_back(elimination.step_at[j] + k);
    }
    const Eigen::MatrixXd joint = sg::solve::joint_covariance(elimination, some);
    CHECK((joint - inverse(rows, rows)).norm() < 1e-9 * inverse.norm());
  }
}
