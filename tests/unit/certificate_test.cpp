// The certificate's bound against dense algebra written out once more, against many optima of one graph, and at a local
// minimum that is known in closed form.
#include "lib/solve/certificate.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>

#include "formats/formats.h"
#include "lib/factor/initialize.h"
#include "lib/geometry/numbers.h"
#include "lib/order/order.h"
#include "lib/solve/batch.h"
#include "lib/world/grid3d.h"
#include "lib/world/manhattan.h"
#include "lib/world/sphere.h"
#include "tests/unit/common.h"

using namespace sg;
using namespace sg::test;

namespace {

Graph generated(const auto& world) {
  std::string text;
  sg::world::Out out{[&](std::string_view piece) { text += piece; }};
  write_graph(world, sg::world::Copy::noisy, out);
  sg::world::flush(out);
  return graph_of(text);
}

factor::Values optimum(const factor::Problem& problem, factor::Values values) {
  factor::LinearSystem system = factor::make_linear_system(problem);
  graph::Order order(problem.variables.pattern.variables());
  for (Index j = 0; j < static_cast<Index>(order.size()); ++j) order[j] = j;
  const auto solver = solve::find_backend("tree").make(system, order, 1);
  solve::BatchOptions options;
  options.tolerance = 1e-13;
  solve::optimize(problem, system, solver, options, values);
  return values;
}

// A ring of poses, each of which turned by 2 pi / n to the left of the last, whose estimates wind `windings` times too often:
// every residual angle is 2 pi windings / n, all alike, which is a local minimum where that is small.
std::string ring(int n, int windings) {
  const double turn = 2 * M_PI / n, wrong = 2 * M_PI * (1 + windings) / n;
  std::string text;
  // Positions do not count: the angle's weight alone is not 0.
  for (int k = 0; k < n; ++k)
    text += "VERTEX_SE2 " + std::to_string(k) + " 0 0 " +
            std::to_string(std::remainder(wrong * k, 2 * M_PI)) + "\n";
  for (int k = 0; k < n; ++k)
    text += "EDGE_SE2 " + std::to_string(k) + " " + std::to_string((k + 1) % n) + " 0 0 " +
            std::to_string(turn) + " 1 0 0 1 0 4\n";
  return text;
}

// The least eigenvalue of Q - L and tr(L), by dense algebra, of a graph of EDGE_SE3:QUAT: rotations and positions in one
// matrix of 4 by 4 blocks, as in the paper's appendix; positions by a pseudo-inverse.
std::pair<double, double> dense_certificate(const factor::Problem& problem,
                                            const factor::Values& values) {
  const Graph& graph = *problem.graph;
  const int n = graph.vertices();
  Eigen::MatrixXd RR = Eigen::MatrixXd::Zero(3 * n, 3 * n), RT = Eigen::MatrixXd::Zero(3 * n, n),
                  TT = Eigen::MatrixXd::Zero(n, n), R(3, 3 * n), T(3, n);
  for (Index v = 0; v < n; ++v) {
    const SE3 x = geometry::se3(values.data() + problem.value_at[v]);
    R.middleCols(3 * v, 3) = x.q.toRotationMatrix();
    T.col(v) = x.t;
  }
  std::vector<double> numbers;
  for (Index e = 0; e < graph.edges(); ++e) {
    graph::edge_numbers(graph, e, numbers);
    const SE3 z = normalized(geometry::se3(numbers.data()));
    const double tau = numbers[7], kappa = numbers[7 + 15] / 8;
    const int i = graph.edge(e)[0], j = graph.edge(e)[1];
    Eigen::MatrixXd u = Eigen::MatrixXd::Zero(4 * n, 1), B = Eigen::MatrixXd::Zero(3 * n, 3);
    u(3 * n + j) = 1, u(3 * n + i) = -1;
    u.block(3 * i, 0, 3, 1) = -z.t;
    B.middleRows(3 * j, 3) = Eigen::Matrix3d::Identity();
    B.middleRows(3 * i, 3) = -z.q.toRotationMatrix();
    RR += kappa * B * B.transpose();
    const Eigen::MatrixXd uu = tau * u * u.transpose();
    RR += uu.topLeftCorner(3 * n, 3 * n);
    RT += uu.topRightCorner(3 * n, n);
    TT += uu.bottomRightCorner(n, n);
  }
  Eigen::MatrixXd Q =
      RR - RT * TT.completeOrthogonalDecomposition().pseudoInverse() * RT.transpose();
  const Eigen::MatrixXd gradient = R * RR + T * RT.transpose();
  double trace = 0;
  for (int v = 0; v < n; ++v) {
    const Eigen::Matrix3d L = R.middleCols(3 * v, 3).transpose() * gradient.middleCols(3 * v, 3);
    Q.block(3 * v, 3 * v, 3, 3) -= (L + L.transpose()) / 2;
    trace += L.trace();
  }
  return {Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(Q).eigenvalues()[0], trace};
}

}  // namespace

TEST_CASE("the certificate is that of dense algebra, at optima and elsewhere", "[solve]") {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Graph graph = generated(sg::world::grid3d({.poses = 24, .seed = seed}));
    const factor::Problem problem = factor::make_problem(graph);
    factor::Values values = factor::start_values(problem);
    for (const bool solved : {false, true}) {
      INFO("seed " << seed << (solved ? ", solved" : ", start"));
      if (solved) values = optimum(problem, values);
      const solve::Certificate certificate = solve::certify(problem, values);
      const auto [eigenvalue, trace] = dense_certificate(problem, values);
      CHECK(certificate.eigenvalue == Approx(eigenvalue).epsilon(1e-6).margin(1e-5));
      CHECK(
          certificate.bound ==
          Approx(std::max(0.0, trace + std::min(0.0, eigenvalue) * 72)).epsilon(1e-6).margin(1e-2));
      CHECK(certificate.isotropic == graph.edges());
      CHECK(solve::is_certified(certificate) == solved);
      if (solved) CHECK(certificate.bound == Approx(certificate.chi2).epsilon(1e-6));
    }
  }
}

TEST_CASE("global optima are certified, in the plane and in space", "[solve]") {
  const auto check = [](const Graph& graph) {
    const factor::Problem problem = factor::make_problem(graph);
    const factor::Values values = optimum(problem, factor::start_values(problem));
    const solve::Certificate certificate = solve::certify(problem, values);
    CHECK(solve::is_certified(certificate));
    CHECK(certificate.bound <= certificate.chi2 * (1 + 1e-9));
    CHECK(certificate.in_part + certificate.left_out == 0);
  };
  for (const std::uint64_t seed : {1, 2, 3}) {
    check(generated(sg::world::manhattan({.poses = 200, .seed = seed})));
    check(generated(sg::world::sphere({.poses = 150, .seed = seed})));
  }
}

TEST_CASE("a ring that winds once too often is a local minimum, and not certified", "[solve]") {
  for (const int n : {12, 20, 50}) {
    INFO("n " << n);
    const Graph wrong = graph_of(ring(n, 1)), right = graph_of(ring(n, 0));
    const factor::Problem problem = factor::make_problem(wrong);
    const factor::Values stuck = optimum(problem, factor::start_values(problem));
    // It is an optimum: no step leaves it.
    const double angle = 2 * M_PI / n;
    CHECK(factor::chi2(problem, stuck) == Approx(4 * n * angle * angle).epsilon(1e-4));
    const solve::Certificate certificate = solve::certify(problem, stuck);
    CHECK_FALSE(solve::is_certified(certificate));
    CHECK(certificate.eigenvalue < -1e-3);
    CHECK(certificate.bound < 1e-3);  // the other optimum has 0
    const factor::Problem other = factor::make_problem(right);
    CHECK(solve::is_certified(solve::certify(other, factor::start_values(other))));
  }
}

TEST_CASE("the bound holds for every estimate, whatever information and edges there are",
          "[solve]") {
  for (int seed = 0; seed < 20; ++seed) {
    INFO("seed " << seed);
    Random random(static_cast<unsigned>(seed));
    const auto number = [&](double most) {
      return " " + std::to_string(uniform(random, -most, most));
    };
    std::string text;
    for (int k = 0; k < 6; ++k)
      text += "VERTEX_SE2 " + std::to_string(k) + number(3) + number(3) + number(3) + "\n";
    text += "VERTEX_XY 9" + number(3) + number(3) + "\n";
    for (int k = 0; k < 12; ++k) {
      const int a = draw(random, 0, 5), b = (a + draw(random, 1, 5)) % 6;
      text += "EDGE_SE2 " + std::to_string(a) + " " + std::to_string(b) + number(2) + number(2) +
              number(3) + (k % 2 ? " 3 1 0.5 2 -0.3 4\n" : " 2 0 0 2 0 5\n");
    }
    text +=
        "EDGE_SE2_XY 0 9 1 1 2 1 3\nEDGE_SE2_XY 3 9 -1 1 2 0 2\nEDGE_PRIOR_SE2 2 1 1 1 1 0 0 1 0 "
        "1\n";
    const Graph graph = graph_of(text);
    const factor::Problem problem = factor::make_problem(graph);
    double least = factor::chi2(problem, factor::start_values(problem)), most_bound = 0;
    for (int k = 0; k < 10; ++k) {
      factor::Values values = factor::start_values(problem);
      for (double& x : values) x += uniform(random, -2, 2);
      try {
        values = optimum(problem, values);
      } catch (const text::Error&) {
        continue;  // a start that leads nowhere
      }
      const solve::Certificate certificate = solve::certify(problem, values);
      least = std::min(least, certificate.chi2);
      most_bound = std::max(most_bound, certificate.bound);
      CHECK(certificate.isotropic == 7);
      CHECK(certificate.in_part == 7);
      CHECK(certificate.left_out == 1);
    }
    CHECK(most_bound <= least * (1 + 1e-9));
  }
}

TEST_CASE("a graph that no certificate speaks of", "[solve]") {
  const Graph graph = graph_of("VERTEX_XY 0 0 0\nVERTEX_XY 1 1 1\nEDGE_POINTXY 0 1 1 1 1 0 1\n");
  const factor::Problem problem = factor::make_problem(graph);
  CHECK_THROWS_AS(solve::certify(problem, factor::start_values(problem)), text::Error);
}
