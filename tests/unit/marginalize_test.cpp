// Marginalization against dense matrices: what is left of a graph is the Schur complement of what was.
#include "lib/marginalize/marginalize.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <numeric>

#include "lib/marginalize/prices.h"
#include "lib/marginalize/recover.h"
#include "lib/order/order.h"
#include "lib/score/divergence.h"
#include "lib/text/error.h"
#include "tests/unit/common.h"
#include "tests/unit/marginal_worlds.h"

using namespace sg;
using namespace sg::test;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

double distance(const MatrixXd& a, const MatrixXd& b) {
  return (a - b).norm() / (1 + b.norm());
}

}  // namespace

TEST_CASE("a linear factor for what went leaves the Schur complement", "[marginalize]") {
  for (int seed = 0; seed < 40; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Subject full(random_text(random, {.plane = seed % 2 == 0,
                                            .poses = draw(random, 3, 10),
                                            .closures = draw(random, 0, 8),
                                            .landmarks = draw(random, 0, 4),
                                            .anchored = seed % 3 == 0}));
    const std::vector<bool> removed = some_vertices(random, full.graph);
    const Gaussian expected = schur(full, removed);
    const Subject left(
        rewritten(full, marginalize::marginalize(full.at(), removed, {.linear = true})));
    const marginalize::Piece given = left.whole();
    REQUIRE(given.information.rows() == expected.information.rows());
    CHECK(distance(given.information, expected.information) < 1e-10);
    CHECK(distance(given.gradient, expected.gradient) < 1e-9);
  }
}

TEST_CASE("marginalizing in turns is marginalizing at once", "[marginalize]") {
  for (int seed = 0; seed < 10; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Subject full(random_text(random, {.plane = seed % 2 == 0}));
    std::vector<bool> removed = some_vertices(random, full.graph);
    const Gaussian expected = schur(full, removed);
    std::vector<bool> first = removed;
    for (Index v = 0; v < full.graph.vertices(); v += 2) first[v] = false;
    const Subject half(
        rewritten(full, marginalize::marginalize(full.at(), first, {.linear = true})));
    std::vector<bool> second(half.graph.vertices(), false);
    for (Index v = 0; v < half.graph.vertices(); ++v)
      second[v] = removed[*graph::find_vertex(full.graph, half.graph.id[v])];
    const Subject left(
        rewritten(half, marginalize::marginalize(half.at(), second, {.linear = true})));
    const marginalize::Piece given = left.whole();
    CHECK(distance(given.information, expected.information) < 1e-9);
    CHECK(distance(given.gradient, expected.gradient) < 1e-8);
  }
}

TEST_CASE("points that only vectors join are a linear problem, and their estimates stay",
          "[marginalize]") {
  for (int seed = 0; seed < 10; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    std::string text = "EDGE_PRIOR_XY 0 1 2 3 0 3\n";
    for (int k = 0; k < 8; ++k)
      text += "VERTEX_XY " + std::to_string(k) + numbers(random_numbers(random, 2, 9)) + "\n";
    for (int k = 1; k < 16; ++k)
      text += "EDGE_POINTXY " + std::to_string(k < 8 ? k - 1 : draw(random, 0, 3)) + " " +
              std::to_string(k < 8 ? k : draw(random, 4, 7)) +
              numbers(random_numbers(random, 2, 3)) + numbers(random_triangle(random, 2)) + "\n";
    const Subject full(text);
    const std::vector<bool> removed = some_vertices(random, full.graph);
    const marginalize::Piece before = full.whole();
    const VectorXd solution = before.information.ldlt().solve(before.gradient);
    const Subject left(
        rewritten(full, marginalize::marginalize(full.at(), removed, {.linear = true})));
    const marginalize::Piece after = left.whole();
    const VectorXd rest = after.information.ldlt().solve(after.gradient);
    for (Index v = 0, k = 0; v < full.graph.vertices(); ++v) {
      if (removed[v]) continue;
      CHECK((rest.segment(2 * k, 2) - solution.segment(2 * v, 2)).norm() < 1e-9);
      ++k;
    }
  }
}

namespace {

// Slopes as pairs of a blanket have: each between two of n things of dimension d, the first of which is held.
struct Problem {
  std::vector<MatrixXd> tree, further;
  MatrixXd covariance;
};
Problem random_problem(Random& random, int n, int d) {
  const int m = (n - 1) * d;
  Problem problem;
  const auto slope = [&](int i, int j) {
    MatrixXd J = MatrixXd::Zero(d, m);
    for (const int end : {i, j}) {
      const MatrixXd block =
          MatrixXd::NullaryExpr(d, d, [&] { return uniform(random, -0.5, 0.5); }) +
          (end == i ? -1 : 1) * MatrixXd::Identity(d, d);
      if (end > 0) J.middleCols((end - 1) * d, d) = block;
    }
    return J;
  };
  for (int j = 1; j < n; ++j) problem.tree.push_back(slope(draw(random, 0, j - 1), j));
  for (int j = 2; j < n; ++j) problem.further.push_back(slope(draw(random, 0, j - 1), j));
  const MatrixXd root = MatrixXd::NullaryExpr(m, m, [&] { return uniform(random, -1, 1); }) +
                        2 * MatrixXd::Identity(m, m);
  problem.covariance = root.transpose() * root;
  return problem;
}

MatrixXd sum_of(const std::vector<MatrixXd>& slopes, const std::vector<MatrixXd>& information) {
  MatrixXd Q = MatrixXd::Zero(slopes[0].cols(), slopes[0].cols());
  for (std::size_t k = 0; k < slopes.size(); ++k)
    Q += slopes[k].transpose() * information[k] * slopes[k];
  return Q;
}

// By its definition.
double divergence(const MatrixXd& Q, const MatrixXd& covariance) {
  const MatrixXd product = Q * covariance;
  return (product.trace() - static_cast<double>(Q.rows()) - std::log(product.determinant())) / 2;
}

double least_eigenvalue(const MatrixXd& matrix) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(matrix).eigenvalues()[0];
}

// The slope of twice the divergence in W_k.
MatrixXd gradient(const MatrixXd& J, const MatrixXd& Q, const MatrixXd& covariance) {
  return J * (covariance - Q.inverse()) * J.transpose();
}

}  // namespace

TEST_CASE("a tree's informations are the inverses of its pairs' covariances, and optimal",
          "[marginalize]") {
  for (int seed = 0; seed < 20; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Problem problem = random_problem(random, draw(random, 2, 6), seed % 2 == 0 ? 3 : 6);
    const marginalize::Recovery tree = marginalize::recover(problem.tree, problem.covariance);
    const MatrixXd Q = sum_of(problem.tree, tree.information);
    for (std::size_t k = 0; k < problem.tree.size(); ++k) {
      const MatrixXd& J = problem.tree[k];
      CHECK(distance(tree.information[k], (J * problem.covariance * J.transpose()).inverse()) <
            1e-9);
      CHECK(gradient(J, Q, problem.covariance).norm() <
            1e-9 * (J * problem.covariance * J.transpose()).norm());
    }
    CHECK(tree.divergence == Approx(divergence(Q, problem.covariance)).margin(1e-9));
  }
}

TEST_CASE("more pairs are at their optimum: no slope where information is, none to more of it",
          "[marginalize]") {
  for (int seed = 0; seed < 20; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const int d = seed % 2 == 0 ? 3 : 6;
    const Problem problem = random_problem(random, draw(random, 3, d == 3 ? 5 : 4), d);
    std::vector<MatrixXd> slopes = problem.tree;
    slopes.insert(slopes.end(), problem.further.begin(), problem.further.end());
    const marginalize::Recovery more = marginalize::recover(slopes, problem.covariance);
    const MatrixXd Q = sum_of(slopes, more.information);
    for (std::size_t k = 0; k < slopes.size(); ++k) {
      const MatrixXd A = slopes[k] * problem.covariance * slopes[k].transpose();
      const MatrixXd Z = gradient(slopes[k], Q, problem.covariance);
      const MatrixXd root = A.llt().matrixL().solve(MatrixXd::Identity(d, d));
      CHECK(least_eigenvalue(root * Z * root.transpose()) > -1e-5);
      CHECK(std::abs((more.information[k] * Z).trace()) < 1e-7);
      CHECK(more.information[k].llt().info() == Eigen::Success);
    }
    CHECK(more.divergence == Approx(divergence(Q, problem.covariance)).margin(1e-9));
    CHECK(more.divergence <=
          marginalize::recover(problem.tree, problem.covariance).divergence + 1e-9);
  }
}

TEST_CASE("a Gaussian that measurements make is recovered whole", "[marginalize]") {
  for (int seed = 0; seed < 10; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    Problem problem = random_problem(random, 4, 3);
    std::vector<MatrixXd> slopes = problem.tree, information;
    slopes.insert(slopes.end(), problem.further.begin(), problem.further.end());
    for (std::size_t k = 0; k < slopes.size(); ++k) {
      const MatrixXd root = MatrixXd::NullaryExpr(3, 3, [&] { return uniform(random, -1, 1); });
      information.push_back(root.transpose() * root + MatrixXd::Identity(3, 3));
    }
    const MatrixXd Q = sum_of(slopes, information);
    const marginalize::Recovery found = marginalize::recover(slopes, Q.inverse());
    CHECK(found.divergence < 1e-8);
    CHECK(distance(sum_of(slopes, found.information), Q) < 1e-4);
    const marginalize::Recovery careful =
        marginalize::recover(slopes, Q.inverse(), {.conservative = true});
    CHECK(careful.divergence < 1e-6);
  }
}

TEST_CASE("what is conservative never knows more, and as little less as it has to",
          "[marginalize]") {
  for (int seed = 0; seed < 20; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Problem problem = random_problem(random, draw(random, 2, 5), 3);
    const marginalize::Recovery bold = marginalize::recover(problem.tree, problem.covariance),
                                careful = marginalize::recover(problem.tree, problem.covariance,
                                                               {.conservative = true});
    const MatrixXd whole = problem.covariance.inverse(),
                   Q = sum_of(problem.tree, careful.information);
    CHECK(least_eigenvalue(whole - Q) > -1e-9 * whole.norm());
    CHECK(careful.divergence >= bold.divergence - 1e-9);
    // A tree's own, scaled until it knows no more, is one of those to choose from.
    const MatrixXd bolder = sum_of(problem.tree, bold.information);
    const MatrixXd L = problem.covariance.llt().matrixL();
    const double most = -least_eigenvalue(-(L.transpose() * bolder * L));
    CHECK(careful.divergence <=
          divergence(bolder / std::max(1.0, most), problem.covariance) + 1e-7);
  }
}

TEST_CASE("poses on a chain leave what composition leaves, whatever the topology",
          "[marginalize]") {
  for (int seed = 0; seed < 8; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Subject full(random_text(
        random,
        {.plane = seed % 2 == 0, .poses = 7, .closures = 0, .landmarks = 0, .consistent = true}));
    std::vector<bool> removed(full.graph.vertices(), false);
    removed[1] = removed[2] = removed[4] = true;
    const Gaussian expected = schur(full, removed);
    for (const auto clusters : {marginalize::Clusters::online, marginalize::Clusters::batch,
                                marginalize::Clusters::global}) {
      const Subject left(
          rewritten(full, marginalize::marginalize(full.at(), removed, {.clusters = clusters})));
      CHECK(left.graph.edges() == 3);
      CHECK(distance(left.whole().information, expected.information) < 1e-9);
    }
  }
}

namespace {

// The divergence of what is left from the Schur complement, the first pose held in both.
double divergence_of(const Subject& full, const std::vector<bool>& removed,
                     const marginalize::Rule& rule) {
  const Subject left(rewritten(full, marginalize::marginalize(full.at(), removed, rule)));
  const MatrixXd p = schur(full, removed).information, q = left.whole().information;
  REQUIRE(p.rows() == q.rows());
  const int held = full.at().dim(0);
  const auto rest = p.rows() - held;
  return divergence(q.bottomRightCorner(rest, rest), p.bottomRightCorner(rest, rest).inverse());
}

}  // namespace

TEST_CASE("the denser the topology, the nearer the Gaussian", "[marginalize]") {
  using enum marginalize::Topology;
  double lost = 0;
  for (int seed = 0; seed < 12; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    // At estimates that agree with the measurements, where slopes are those of the recovered measurements, too.
    const Subject full(random_text(
        random,
        {.plane = seed % 3 != 0, .poses = 6, .closures = 8, .landmarks = 0, .consistent = true}));
    std::vector<bool> removed(full.graph.vertices(), false);
    removed[2] = removed[3] = true;
    const auto of = [&](marginalize::Rule rule) {
      rule.clusters = marginalize::Clusters::global;
      return marginalize::marginalize(full.at(), removed, rule).divergence;
    };
    const double tree = of({.sparsity = {.topology = marginalize::Topology::tree}}),
                 one = of({.sparsity = {.topology = subgraph, .extra = 1}}),
                 two = of({.sparsity = {.topology = subgraph, .extra = 2}}),
                 all = of({.sparsity = {.topology = dense}});
    CHECK(tree + 1e-9 >= one);
    CHECK(one + 1e-9 >= two);
    CHECK(two + 1e-9 >= all);
    CHECK(all >= -1e-9);
    lost += tree;
    CHECK(divergence_of(full, removed, {.linear = true}) < 1e-9);
  }
  CHECK(lost > 1);
}

TEST_CASE("a graph's divergence from a larger one is that of dense Gaussians", "[marginalize]") {
  for (int seed = 0; seed < 20; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const bool anchored = seed % 4 == 0;
    const Subject full(random_text(random, {.plane = anchored || seed % 2 == 0,
                                            .poses = 7,
                                            .closures = 9,
                                            .landmarks = 2,
                                            .anchored = anchored}));
    std::vector<bool> removed(full.graph.vertices(), false);
    for (Index v = 1; v < 7; v += draw(random, 1, 2)) removed[v] = true;
    for (const bool linear : {false, true}) {
      const Subject left(
          rewritten(full, marginalize::marginalize(full.at(), removed, {.linear = linear})));
      const auto held = anchored ? 0 : full.at().dim(0);
      Gaussian p = schur(full, removed);
      marginalize::Piece q = left.whole();
      const auto rest = p.gradient.size() - held;
      const MatrixXd P = p.information.bottomRightCorner(rest, rest),
                     Q = q.information.bottomRightCorner(rest, rest);
      const VectorXd apart =
          P.ldlt().solve(p.gradient.tail(rest)) - Q.ldlt().solve(q.gradient.tail(rest));
      const auto given = score::divergence(left.graph, full.graph);
      REQUIRE(given);
      const double expected = divergence(Q, P.inverse()) + apart.dot(Q * apart) / 2;
      CHECK(given->kld == Approx(expected).epsilon(1e-7).margin(1e-8));
      const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> ratios(Q, P);
      CHECK(given->overconfidence == Approx(ratios.eigenvalues().maxCoeff()).epsilon(1e-6));
      if (linear) CHECK(given->kld < 1e-8);
      if (linear) CHECK(given->overconfidence == Approx(1).epsilon(1e-8));
    }
    const auto same = score::divergence(full.graph, full.graph);
    REQUIRE(same);
    CHECK(same->kld < 1e-9);
    const Subject less(
        "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 999 1 0 0\nEDGE_SE2 0 999 1 0 0 1 0 0 1 0 1\n");
    CHECK(!score::divergence(less.graph, full.graph));
  }
}

TEST_CASE("no spanning tree is nearer than that which is chosen", "[marginalize]") {
  for (int seed = 0; seed < 10; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Subject full(
        random_text(random, {.plane = seed % 2 == 0, .poses = 5, .closures = 8, .landmarks = 0}));
    const marginalize::At at = full.at();
    const marginalize::Piece rest = marginalize::eliminated(at, full.whole(), 2);
    const marginalize::Blanket around = marginalize::blanket(at, rest);
    const auto pairs = marginalize::candidate_pairs(at, rest, around);
    REQUIRE(pairs.size() == 6);
    const marginalize::Tree tree = marginalize::spanning_tree(at, around, pairs, rest.absolute);
    CHECK(tree.missing == -1);
    REQUIRE(tree.pairs.size() == 3);
    const auto divergence_on = [&](const std::vector<Index>& which) {
      std::vector<MatrixXd> slopes;
      for (const Index k : which) slopes.push_back(marginalize::spread(around, pairs[k]));
      MatrixXd stacked(around.information.rows(), around.information.cols());
      for (std::size_t k = 0; k < which.size(); ++k)
        stacked.middleRows(k * slopes[k].rows(), slopes[k].rows()) = slopes[k];
      if (std::abs(stacked.determinant()) < 1e-6) return 1e9;  // no tree
      return marginalize::recover(slopes, around.covariance).divergence;
    };
    const double chosen = divergence_on(tree.pairs);
    for (Index a = 0; a < 6; ++a) {
      for (Index b = a + 1; b < 6; ++b) {
        for (Index c = b + 1; c < 6; ++c) CHECK(divergence_on({a, b, c}) >= chosen - 1e-9);
      }
    }
  }
}

TEST_CASE("what no measurement can say is named by its line", "[marginalize]") {
  const Subject full(
      "PARAMS_CAMERAPARAMETERS 0 500 320 240 0\nVERTEX_SE3:EXPMAP 0 0 0 0 0 0 0 1\n"
      "VERTEX_SE3:EXPMAP 1 1 0 0 0 0 0 1\nVERTEX_XYZ 2 0 0 5\n"
      "EDGE_PROJECT_XYZ2UV:EXPMAP 2 0 0 445 365 1 0 1\nEDGE_PROJECT_XYZ2UV:EXPMAP 2 1 0 320 365 1 "
      "0 1\n"
      "EDGE_SE3:EXPMAP 0 1 1 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n");
  std::string message;
  try {
    marginalize::marginalize(full.at(), {false, true, false}, {});
  } catch (const text::Error& error) {
    message = text::message(error);
  }
  CHECK(message ==
        "test.g2o:6: vertex 1 of this EDGE_PROJECT_XYZ2UV:EXPMAP cannot be taken out: no "
        "measurement between two "
        "vertices would say where VERTEX_XYZ 2 is beside its other neighbours (--topology dense "
        "leaves a linear factor)");
  CHECK(
      marginalize::marginalize(full.at(), {false, true, false}, {.linear = true}).factors.size() ==
      1);
}

TEST_CASE("many pairs, each in turn, are as near their optimum as is said", "[marginalize]") {
  for (int seed = 0; seed < 12; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const int d = seed % 2 == 0 ? 3 : 6;
    const Problem problem = random_problem(random, d == 3 ? 14 : 5, d);
    std::vector<MatrixXd> slopes = problem.tree;
    slopes.insert(slopes.end(), problem.further.begin(), problem.further.end());
    REQUIRE(slopes.size() * d * (d + 1) / 2 > marginalize::most_unknowns);
    const marginalize::Recovery more =
        marginalize::recover(slopes, problem.covariance, {.gap = 1e-7});
    const MatrixXd Q = sum_of(slopes, more.information);
    double excess = 0;
    for (std::size_t k = 0; k < slopes.size(); ++k) {
      const MatrixXd A = slopes[k] * problem.covariance * slopes[k].transpose();
      const MatrixXd Z = gradient(slopes[k], Q, problem.covariance);
      const MatrixXd root = A.llt().matrixL().solve(MatrixXd::Identity(d, d));
      excess = std::max(excess, -least_eigenvalue(root * Z * root.transpose()));
      CHECK(std::abs((more.information[k] * Z).trace()) < 1e-4);
      CHECK(more.information[k].llt().info() == Eigen::Success);
    }
    CHECK(excess < 1e-4);
    CHECK(more.divergence == Approx(divergence(Q, problem.covariance)).margin(1e-9));
    const marginalize::Recovery rough =
        marginalize::recover(slopes, problem.covariance, {.gap = 0.1});
    CHECK(rough.divergence >= more.divergence - 1e-7);
    CHECK(rough.divergence <= more.divergence + 0.05);
  }
}

TEST_CASE("multiples of a tree's informations are the best multiples", "[marginalize]") {
  for (int seed = 0; seed < 10; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Problem problem = random_problem(random, 5, 3);
    std::vector<MatrixXd> slopes = problem.tree;
    slopes.insert(slopes.end(), problem.further.begin(), problem.further.end());
    const marginalize::Recovery found =
        marginalize::recover(slopes, problem.covariance, {.penalty = 0.5, .multiples = true});
    const MatrixXd Q = sum_of(slopes, found.information);
    for (std::size_t k = 0; k < slopes.size(); ++k) {
      const MatrixXd A = slopes[k] * problem.covariance * slopes[k].transpose();
      const double w = (found.information[k] * A).trace() / 3;
      CHECK(distance(found.information[k], w * A.inverse()) < 1e-9);
      const double slope =
          (A.inverse() * gradient(slopes[k], Q, problem.covariance)).trace() + 0.5 * 3;
      CHECK(slope > -1e-6);
      CHECK(std::abs(w * slope) < 1e-7);
    }
  }
}

TEST_CASE("what is recovered has the gradient of what went, whatever the topology",
          "[marginalize]") {
  using enum marginalize::Topology;
  for (int seed = 0; seed < 16; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const bool plane = seed % 2 == 0;
    const std::string text = random_text(
        random, {.plane = plane, .poses = 9, .closures = 9, .landmarks = 0, .consistent = true});
    // One that says something else.
    const Subject full(text + (plane ? "EDGE_SE2 3 4 1 0.01 0.02 1 0 0 1 0 1\n"
                                     : "EDGE_SE3:QUAT 3 4 1 0.01 0.02 0.01 0 0 1 1 0 0 0 0 0 1 0 0 "
                                       "0 0 1 0 0 0 1 0 0 1 0 1\n"));
    std::vector<bool> removed(full.graph.vertices(), false);
    removed[2] = removed[3] = removed[6] = true;
    const VectorXd expected = schur(full, removed).gradient;
    REQUIRE(expected.norm() > 0.01);
    for (const auto topology : {tree, subgraph, ec, dense}) {
      const Subject left(
          rewritten(full, marginalize::marginalize(full.at(), removed,
                                                   {.sparsity = {.topology = topology},
                                                    .clusters = marginalize::Clusters::global})));
      CHECK((left.whole().gradient - expected).norm() < 1e-6 * expected.norm());
    }
  }
}

TEST_CASE("a price is what EC grows by, scored anew", "[marginalize]") {
  for (int seed = 0; seed < 20; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Subject full(
        random_text(random, {.plane = seed % 2 == 0, .poses = 12, .closures = 6, .landmarks = 3}));
    graph::GraphPattern pattern = graph::graph_pattern(full.graph);
    const graph::Order order = order::elimination_order("wmf", pattern.pattern);
    std::vector<bool> removed(full.graph.vertices(), false);
    removed[11] = true;
    marginalize::Prices sheet = marginalize::prices(pattern, order, removed, 1);
    elim::Wide before = elim::elimination_complexity(pattern.pattern, order);
    CHECK(sheet.average == before / static_cast<elim::Wide>(full.graph.edges()));
    for (int k = 0; k < 12; ++k) {
      const Index u = draw(random, 0, 10), v = draw(random, 0, 10);
      if (u == v) continue;
      const marginalize::Measurable of = *marginalize::between(full.at(), u, v);
      const std::vector<Index> row{std::min(u, v), std::max(u, v)};
      pattern.pattern.rows.add(row);
      const elim::Wide after = elim::elimination_complexity(pattern.pattern, order);
      CHECK(marginalize::price(sheet, of) == after - before);
      marginalize::pay(sheet, of);
      CHECK(marginalize::price(sheet, of) == 0);
      before = after;
      CHECK(marginalize::price(sheet, *marginalize::between(full.at(), u, 11)) == sheet.average);
    }
  }
}

TEST_CASE("the dearer EC, the less of it, and the more is lost", "[marginalize]") {
  double least_ec = 0, least_lost = 0, most_ec = 0, most_lost = 0;
  for (int seed = 0; seed < 6; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Subject full(random_text(
        random, {.plane = true, .poses = 16, .closures = 14, .landmarks = 0, .consistent = true}));
    std::vector<bool> removed(full.graph.vertices(), false);
    for (Index v = 1; v < 16; v += 2) removed[v] = true;
    const auto run = [&](marginalize::Sparsity sparsity, double& lost) {
      sparsity.topology = marginalize::Topology::ec;
      const auto result = marginalize::marginalize(
          full.at(), removed, {.sparsity = sparsity, .clusters = marginalize::Clusters::global});
      lost += result.divergence;
      const graph::Pattern left = marginalize::pattern_left(full.graph, result).pattern;
      return elim::to_double(
          elim::elimination_complexity(left, order::elimination_order("wmf", left)));
    };
    double lost = 0;
    const double cheap = run({.price = 0.01}, least_lost), dear = run({.price = 100}, most_lost);
    most_ec += cheap;
    least_ec += dear;
    const double budget = (cheap + dear) / 2;
    if (dear < budget) CHECK(run({.ec = budget}, lost) <= budget);
  }
  CHECK(least_ec < 0.9 * most_ec);
  CHECK(least_lost < 0.9 * most_lost);
}

TEST_CASE("what types alone tell is told before anything is computed", "[marginalize]") {
  // Pose 1 could go; that 5 cannot is found first.
  const Subject full(
      "PARAMS_CAMERAPARAMETERS 0 500 320 240 0\nVERTEX_SE3:EXPMAP 0 0 0 0 0 0 0 1\n"
      "VERTEX_SE3:EXPMAP 1 1 0 0 0 0 0 1\nVERTEX_SE3:EXPMAP 2 1 0 0 0 0 0 1\n"
      "VERTEX_SE3:EXPMAP 5 1 0 0 0 0 0 1\nVERTEX_XYZ 9 0 0 5\n"
      "EDGE_SE3:EXPMAP 0 1 1 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n"
      "EDGE_SE3:EXPMAP 1 2 1 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n"
      "EDGE_SE3:EXPMAP 2 5 1 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n"
      "EDGE_PROJECT_XYZ2UV:EXPMAP 9 5 0 320 365 1 0 1\n");
  bool computed = false;
  std::string message;
  try {
    marginalize::marginalize(full.at(), {false, true, false, true, false}, {},
                             [&](Index) { computed = true; });
  } catch (const text::Error& error) {
    message = text::message(error);
  }
  CHECK(message.starts_with("test.g2o:10: vertex 5 of this EDGE_PROJECT_XYZ2UV:EXPMAP cannot be"));
  CHECK(!computed);
}

TEST_CASE("pairs are taken one by one, each by what those before leave it worth", "[marginalize]") {
  std::size_t taken = 0;
  for (int seed = 0; seed < 12; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Subject full(
        random_text(random, {.plane = true, .poses = 9, .closures = 12, .landmarks = 0}));
    const marginalize::At at = full.at();
    const marginalize::Piece rest = marginalize::eliminated(at, full.whole(), 4);
    const marginalize::Blanket around = marginalize::blanket(at, rest);
    const auto pairs = marginalize::candidate_pairs(at, rest, around);
    const marginalize::Tree tree = marginalize::spanning_tree(at, around, pairs, rest.absolute);
    // What is left beside: a chain.
    std::vector<bool> vertex(full.graph.vertices(), true), edge(full.graph.edges(), false);
    vertex[4] = false;
    graph::GraphPattern left = graph::graph_pattern(full.graph, vertex, edge);
    for (Index k = 1; k < left.pattern.variables(); ++k)
      left.pattern.rows.add(std::vector<Index>{k - 1, k});
    graph::Order order(left.pattern.variables());
    std::iota(order.begin(), order.end(), 0);
    const double rate = seed % 3 == 0 ? 0 : seed % 3 == 1 ? 1e-4 : 3e-4;
    marginalize::Prices sheet =
        marginalize::prices(left, order, std::vector<bool>(full.graph.vertices(), false), rate);
    const std::vector<Index> found = marginalize::worth_their_price(around, pairs, tree, sheet);

    // All again, by inverses and fresh scores.
    const auto complexity = [&] { return elim::elimination_complexity(left.pattern, order); };
    const auto pay = [&](Index k) {
      std::vector<Index> row{left.vertex_variable[pairs[k].of.first],
                             left.vertex_variable[pairs[k].of.second]};
      std::ranges::sort(row);
      left.pattern.rows.add(row);
    };
    MatrixXd P = MatrixXd::Zero(around.information.rows(), around.information.rows());
    for (const Index k : tree.pairs) {
      const MatrixXd J = marginalize::spread(around, pairs[k]);
      P += J.transpose() * (J * around.covariance * J.transpose()).inverse() * J;
      pay(k);
    }
    for (const Index chosen : found) {
      const elim::Wide before = complexity();
      pay(chosen);
      const double cost = elim::to_double(complexity() - before) + 100;
      const MatrixXd J = marginalize::spread(around, pairs[chosen]);
      const MatrixXd A = J * around.covariance * J.transpose(), B = J * P.inverse() * J.transpose();
      const double worth = divergence(B.inverse(), A);
      CHECK(marginalize::surprise(pairs[chosen], P.inverse()) == Approx(worth).epsilon(1e-6));
      CHECK(worth / cost > rate * (1 - 1e-9));
      // It is brought down to what it is, where it was larger, in coordinates in which B = I.
      const MatrixXd L = B.llt().matrixL(), back = L.inverse();
      const Eigen::SelfAdjointEigenSolver<MatrixXd> ratio(back * A * back.transpose());
      const VectorXd more = (ratio.eigenvalues().cwiseInverse().array() - 1).max(0.0);
      const MatrixXd U = back.transpose() * ratio.eigenvectors();
      P += J.transpose() * U * more.asDiagonal() * U.transpose() * J;
    }
    CHECK(sheet.filled.ec == complexity());
    taken += found.size();
    if (found.size() == tree.pairs.size()) continue;
    for (const Index k : marginalize::others(pairs, tree)) {
      if (std::ranges::count(found, k) > 0) continue;
      const double cost = elim::to_double(marginalize::price(sheet, pairs[k].of)) + 100;
      CHECK(marginalize::surprise(pairs[k], P.inverse()) / cost < rate * 1.5 + 1e-12);
    }
  }
  CHECK(taken > 20);
}
