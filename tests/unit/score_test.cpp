// What sg-score measures, against formulas, dense matrices, and numbers worked out by hand.
#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "formats/formats.h"
#include "lib/factor/initialize.h"
#include "lib/factor/linearize.h"
#include "lib/graph/summary.h"
#include "lib/order/order.h"
#include "lib/score/covariance.h"
#include "lib/score/fill.h"
#include "lib/score/sigma.h"
#include "lib/score/trajectory.h"
#include "lib/trees/connectivity.h"
#include "tests/unit/common.h"

using namespace sg;
using namespace sg::test;
using Eigen::MatrixXd;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double pi = std::numbers::pi;
constexpr auto unit = trees::Weights::unit;

struct Edge {
  int u, v;
  double translation = 1, rotation = 1;
};

std::string text_of_graph(int n, const std::vector<Edge>& edges) {
  std::string text;
  for (int i = 0; i < n; ++i) text += "VERTEX_SE2 " + std::to_string(i) + " 0 0 0\n";
  for (const Edge& e : edges) {
    const std::string t = std::to_string(e.translation);
    text += "EDGE_SE2 " + std::to_string(e.u) + " " + std::to_string(e.v) + " 0 0 0 " + t +
            " 0 0 " + t + " 0 " + std::to_string(e.rotation) + "\n";
  }
  return text;
}
Graph graph_of(int n, const std::vector<Edge>& edges) {
  return test::graph_of(text_of_graph(n, edges));
}

std::vector<Edge> path(int n) {
  std::vector<Edge> edges;
  for (int i = 1; i < n; ++i) edges.push_back({i - 1, i});
  return edges;
}
std::vector<Edge> cycle(int n) {
  auto edges = path(n);
  edges.push_back({n - 1, 0});
  return edges;
}
std::vector<Edge> complete(int n) {
  std::vector<Edge> edges;
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) edges.push_back({i, j});
  }
  return edges;
}

double log_det(const Graph& graph) {
  const factor::Problem problem = factor::make_problem(graph);
  const graph::Order order = order::elimination_order("colamd", problem.variables.pattern);
  auto elimination = score::eliminated(problem, factor::file_values(problem), order);
  return elimination ? solve::log_determinant(*elimination) : -infinity;
}

// A' A, by scalar of a step, of the graph's edges and of the gauge.
MatrixXd dense_information(const factor::Problem& problem, const factor::Values& values) {
  factor::LinearSystem system = factor::make_linear_system(problem);
  factor::linearize(problem, values, {}, system);
  MatrixXd information = MatrixXd::Zero(problem.step_at.back(), problem.step_at.back());
  for (Index r = 0; r < system.pattern->rows.size(); ++r) {
    MatrixXd jacobian = MatrixXd::Zero(system.height[r], problem.step_at.back());
    const double* block = system.block(r);
    for (const Index j : system.pattern->rows[r]) {
      const int dim = system.pattern->dim[j];
      jacobian.middleCols(problem.step_at[j], dim) =
          Eigen::Map<const MatrixXd>(block, system.height[r], dim);
      block += std::ptrdiff_t{dim} * system.height[r];
    }
    information += jacobian.transpose() * jacobian;
  }
  return information;
}

// All vertices' covariances in one matrix, by vertex: zero of what no measurement may move. Nothing of a graph that
// leaves something undetermined, by more digits than there are.
std::optional<MatrixXd> dense_covariance(const factor::Problem& problem,
                                         const factor::Values& values) {
  const Graph& graph = *problem.graph;
  std::vector<int> moving, of_all;
  int row = 0;
  for (Index v = 0; v < graph.vertices(); ++v) {
    const Index j = problem.variables.vertex_variable[v];
    for (int k = 0; k < graph.dim(v); ++k, ++row) {
      if (j < 0 || (j == problem.held && k < factor::held_dim(problem))) continue;
      moving.push_back(problem.step_at[j] + k);
      of_all.push_back(row);
    }
  }
  MatrixXd result = MatrixXd::Zero(row, row);
  if (moving.empty()) return result;
  const MatrixXd information = dense_information(problem, values)(moving, moving);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(information);
  if (solver.eigenvalues()[0] < 1e-10 * solver.eigenvalues().tail(1)[0]) return std::nullopt;
  result(of_all, of_all) = information.inverse().eval();
  return result;
}

// Lines of a file of testdata, some edges left out, some vertices fixed.
std::string thinned(Random& random, const std::string& name) {
  const Graph graph = test_graph(name);
  std::string text(graph.text.view);
  for (Index e = 0; e < graph.edges(); ++e) {
    if (draw(random, 0, 9) > 0) continue;
    const auto line = graph::line_at(graph, graph.edge_line[e]);
    std::fill_n(text.begin() + graph.edge_line[e], line.size(), ' ');
  }
  for (int fixed = draw(random, 0, 2); fixed > 0; --fixed)
    text += "\nFIX " + std::to_string(graph.id[draw(random, 0, graph.vertices() - 1)]) + "\n";
  return text;
}

// Where a vertex is, as its file's line says it.
Eigen::VectorXd place(const factor::Problem& problem, const factor::Values& values, Index v) {
  const std::vector<double> numbers = factor::estimate_numbers(problem, values, v);
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), graph::facts(problem.space[v]).position);
}

score::Trajectory flat(const std::vector<std::array<double, 3>>& poses) {
  score::Trajectory result;
  for (const auto& [x, y, theta] : poses) {
    result.id.push_back(static_cast<Id>(result.id.size()));
    result.pose.push_back({geometry::exp_so3({0, 0, theta}), {x, y, 0}});
  }
  return result;
}

}  // namespace

TEST_CASE("spanning trees of known graphs", "[score]") {
  CHECK(trees::log_trees(graph_of(1, {}), unit) == 0);
  CHECK(trees::log_trees(graph_of(2, {}), unit) == -infinity);
  CHECK(trees::log_trees(graph_of(4, {{0, 1}, {2, 3}}), unit) == -infinity);
  for (int n = 2; n <= 30; ++n) {
    CHECK(trees::log_trees(graph_of(n, path(n)), unit) == Approx(0).margin(1e-9));
    CHECK(trees::log_trees(graph_of(n, complete(n)), unit) ==
          Approx((n - 2) * std::log(n)).margin(1e-9));
    if (n > 2) CHECK(trees::log_trees(graph_of(n, cycle(n)), unit) == Approx(std::log(n)));
  }
}

TEST_CASE("spanning trees weigh their edges", "[score]") {
  const double a = 1e-3, b = 1e6, c = 40, d = 2, e = 3, f = 5;
  const Graph triangle = graph_of(3, {{0, 1, a, d}, {1, 2, b, e}, {2, 0, c, f}});
  CHECK(trees::log_trees(triangle, trees::Weights::translation) ==
        Approx(std::log(a * b + b * c + c * a)));
  CHECK(trees::log_trees(triangle, trees::Weights::rotation) ==
        Approx(std::log(d * e + e * f + f * d)));
  CHECK(trees::log_trees(triangle, trees::Weights::dopt) ==
        Approx(2 * std::log(a * b + b * c + c * a) + std::log(d * e + e * f + f * d)));
}

TEST_CASE("fixed vertices are one node, points do not rotate", "[score]") {
  CHECK(trees::log_trees(graph_of(text_of_graph(4, cycle(4)) + "FIX 0 2\n"), unit) ==
        Approx(std::log(4)));
  const Graph point = graph_of(
      "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 0 0 0\nVERTEX_XY 2 0 0\n"
      "EDGE_SE2 0 1 0 0 0 7 0 0 7 0 5\nEDGE_SE2_XY 0 2 0 0 3 0 3\n");
  CHECK(trees::log_trees(point, unit) == Approx(0).margin(1e-12));
  CHECK(trees::log_trees(point, trees::Weights::translation) == Approx(std::log(21)));
  CHECK(trees::log_trees(point, trees::Weights::rotation) == Approx(std::log(5)));
  CHECK(trees::log_trees(point, trees::Weights::dopt) == Approx(2 * std::log(21) + std::log(5)));
  CHECK(graph::average_observations(point) == Approx(1));
  CHECK(!graph::average_observations(graph_of(2, path(2))));
}

TEST_CASE("algebraic connectivity of known graphs", "[score]") {
  CHECK(!trees::algebraic_connectivity(graph_of(1, {}), unit));
  CHECK(trees::algebraic_connectivity(graph_of(2, {}), unit) == 0);
  CHECK(trees::algebraic_connectivity(graph_of(4, {{0, 1}, {2, 3}}), unit) == 0);
  CHECK(!trees::algebraic_connectivity(graph_of(2, path(2)), trees::Weights::dopt));
  for (int n : {2, 3, 10, 64, 65, 100, 700}) {
    CHECK(*trees::algebraic_connectivity(graph_of(n, path(n)), unit) ==
          Approx(2 - 2 * std::cos(pi / n)).epsilon(1e-8));
  }
  for (int n : {3, 10, 65, 300}) {  // a double eigenvalue
    CHECK(*trees::algebraic_connectivity(graph_of(n, cycle(n)), unit) ==
          Approx(2 - 2 * std::cos(2 * pi / n)).epsilon(1e-8));
  }
  for (int n : {2, 5, 70}) {
    CHECK(*trees::algebraic_connectivity(graph_of(n, complete(n)), unit) ==
          Approx(n).epsilon(1e-8));
  }
}

TEST_CASE("the iteration for connectivity gives what dense eigenvalues give", "[score]") {
  Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const int n = draw(random, 65, 150);
    auto edges = path(n);
    const auto node = [&] { return draw(random, 0, n - 1); };
    for (int k = 0; k < n; ++k) edges.push_back({node(), node()});
    MatrixXd laplacian = MatrixXd::Zero(n, n);
    for (Edge& e : edges) {
      e.translation = std::pow(10, uniform(random, -3, 3));
      e.translation = std::stod(std::to_string(e.translation));
      if (e.u == e.v) continue;
      laplacian(e.u, e.u) += e.translation, laplacian(e.v, e.v) += e.translation;
      laplacian(e.u, e.v) -= e.translation, laplacian(e.v, e.u) -= e.translation;
    }
    const double expected = Eigen::SelfAdjointEigenSolver<MatrixXd>(laplacian).eigenvalues()[1];
    CHECK(*trees::algebraic_connectivity(graph_of(n, edges), trees::Weights::translation) ==
          Approx(expected).epsilon(1e-6));
  }
}

TEST_CASE("D-optimality is the log determinant of the dense system", "[score]") {
  CHECK(log_det(graph_of(1, {})) == 0);
  CHECK(log_det(graph_of(2, {{0, 1, 4, 9}})) == Approx(std::log(4 * 4 * 9)));
  CHECK(log_det(graph_of(3, {{0, 1}})) == -infinity);
  Random random(2);
  for (int trial = 0; trial < 30; ++trial) {
    const int n = draw(random, 2, 12);
    auto edges = path(n);
    const auto node = [&] { return draw(random, 0, n - 1); };
    for (int k = 0; k < n; ++k) {
      const int u = node(), v = node();
      if (u != v) edges.push_back({u, v, 1.0 + k, 2.0 + k});
    }
    std::string text;
    const auto place = [&] { return std::to_string(uniform(random, -3, 3)); };
    for (int i = 0; i < n; ++i) {
      text +=
          "VERTEX_SE2 " + std::to_string(i) + " " + place() + " " + place() + " " + place() + "\n";
    }
    const std::string measured = text_of_graph(n, edges);
    const Graph graph = graph_of(text + measured.substr(measured.find("EDGE")));
    const factor::Problem problem = factor::make_problem(graph);
    const MatrixXd information = dense_information(problem, factor::file_values(problem));
    CHECK(log_det(graph) == Approx(std::log(information.determinant())).margin(1e-9));
    // The first pose is held: its own block is the identity, and nothing else touches it.
    const double reduced = information.bottomRightCorner(3 * n - 3, 3 * n - 3).determinant();
    CHECK(log_det(graph) == Approx(std::log(reduced)).margin(1e-9));
  }
}

TEST_CASE("covariances are blocks of the dense inverse, of every type", "[score]") {
  int checked = 0;
  for (const char* name :
       {"types-se2.g2o", "types-se3.g2o", "types-expmap.g2o", "desk.bal", "walk.g2o"}) {
    for (int trial = 0; trial < 20; ++trial) {
      Random random(100 + trial);
      INFO(name << ", trial " << trial);
      const Graph graph = test::graph_of(thinned(random, name));
      const factor::Problem problem = factor::make_problem(graph);
      const factor::Values values = factor::start_values(problem);
      const auto dense = dense_covariance(problem, values);
      if (!dense) continue;
      ++checked;
      auto elimination = score::eliminated(problem, values,
                                           shuffled(random, problem.variables.pattern.variables()));
      REQUIRE(elimination);
      const auto blocks = score::vertex_covariances(problem, *elimination);
      std::vector<int> at{0};
      for (Index v = 0; v < graph.vertices(); ++v) at.push_back(at.back() + graph.dim(v));
      const double bound = 1e-7 * dense->norm();
      double worst = 0;
      for (Index v = 0; v < graph.vertices(); ++v) {
        const int dim = graph.dim(v);
        worst = std::max(worst, (blocks[v] - dense->block(at[v], at[v], dim, dim)).norm());
      }
      CHECK(worst < bound);
      for (int pair = 0; pair < 10; ++pair) {
        const Index a = draw(random, 0, graph.vertices() - 1);
        const Index b = draw(random, 0, graph.vertices() - 1);
        std::vector<int> rows;
        for (const Index v : {a, b}) {
          for (int k = at[v]; k < at[v + 1]; ++k) rows.push_back(k);
        }
        const MatrixXd joint = score::joint_covariance(problem, *elimination, a, b);
        CHECK((joint - (*dense)(rows, rows)).norm() < bound);
      }
    }
  }
  CHECK(checked > 60);
}

TEST_CASE("dropped poses stand between kept ones, by odometry", "[score]") {
  Random random(8);
  const auto motion = [&](double size) {
    return geometry::exp(
        Vector6d(Vector6d::NullaryExpr([&] { return uniform(random, -size, size); })));
  };
  for (int trial = 0; trial < 50; ++trial) {
    const int n = draw(random, 1, 30);
    score::Trajectory all, kept;
    score::Odometry odometry;
    std::vector<bool> known(n);  // that a kept pose of its segment leads to it
    for (int k = 0; k < n; ++k) {
      const bool starts = k == 0 || draw(random, 0, 9) == 0;
      const SE3 step = motion(1);
      all.id.push_back(3 * k);
      all.pose.push_back(k == 0 ? step : compose(all.pose.back(), step));
      odometry.id.push_back(3 * k);
      odometry.step.push_back(starts ? std::nullopt : std::optional(step));
      if (draw(random, 0, 3) > 0) continue;
      kept.id.push_back(3 * k);
      kept.pose.push_back(all.pose.back());
      known[k] = true;
    }
    for (int k = 1; k < n; ++k) known[k] = known[k] || (odometry.step[k] && known[k - 1]);
    for (int k = n - 1; k > 0; --k) known[k - 1] = known[k - 1] || (odometry.step[k] && known[k]);
    kept.id.push_back(3 * n + 1);  // that the odometry does not know
    kept.pose.push_back(motion(1));
    const score::Trajectory filled = score::filled(kept, odometry);
    std::vector<Id> expected;
    double worst = 0;
    for (int k = 0; k < n; ++k) {
      if (!known[k]) continue;
      REQUIRE(expected.size() < filled.pose.size());
      worst = std::max(worst, log(between(all.pose[k], filled.pose[expected.size()])).norm());
      expected.push_back(3 * k);
    }
    expected.push_back(3 * n + 1);
    CHECK(filled.id == expected);
    CHECK(worst < 1e-9);
  }
}

TEST_CASE("a position's covariance is that of where its file's line puts it", "[score]") {
  Random random(7);
  for (const char* name : {"types-se2.g2o", "types-se3.g2o", "types-expmap.g2o", "desk.bal"}) {
    const Graph graph = test_graph(name);
    const factor::Problem problem = factor::make_problem(graph);
    const factor::Values values = factor::start_values(problem);
    for (Index v = 0; v < graph.vertices(); ++v) {
      const int dim = graph.dim(v);
      MatrixXd jacobian(place(problem, values, v).size(), dim);
      for (int k = 0; k < dim; ++k) {
        const auto moved = [&](double h) {
          factor::Values there = values;
          std::vector<double> step(dim, 0.0);
          step[k] = h;
          factor::retract(problem.space[v], step.data(), there.data() + problem.value_at[v]);
          return place(problem, there, v);
        };
        jacobian.col(k) = (moved(1e-5) - moved(-1e-5)) / 2e-5;
      }
      const MatrixXd root = MatrixXd::NullaryExpr(dim, dim, [&] { return uniform(random, -1, 1); });
      const MatrixXd covariance = root * root.transpose();
      const MatrixXd position = score::position_covariance(
          problem.space[v], values.data() + problem.value_at[v], covariance);
      INFO(name << " vertex " << graph.id[v]);
      CHECK((position - jacobian * covariance * jacobian.transpose()).norm() < 1e-6);
    }
  }
}

TEST_CASE("a trajectory moved onto another keeps its other poses beside those that match",
          "[score]") {
  score::Trajectory line = flat({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  score::Trajectory turned =
      flat({{7, 9, pi / 2}, {5, 1, pi / 2}, {5, 2, pi / 2}, {5, 3, pi / 2}, {4, 3, pi / 2}});
  line.id = {3, 5, 8};
  turned.id = {1, 3, 5, 8, 9};
  using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;
  CHECK(score::matched(turned, line) == Pairs{{1, 0}, {2, 1}, {3, 2}});
  CHECK(score::matched(line, turned) == Pairs{{0, 1}, {1, 2}, {2, 3}});
  const score::Trajectory moved = score::aligned(turned, line, score::Alignment::se);
  const std::vector<std::pair<double, double>> places{{8, -2}, {0, 0}, {1, 0}, {2, 0}, {2, 1}};
  for (std::size_t k = 0; k < places.size(); ++k) {
    CHECK(moved.pose[k].t.x() == Approx(places[k].first).margin(1e-12));
    CHECK(moved.pose[k].t.y() == Approx(places[k].second).margin(1e-12));
    CHECK(moved.pose[k].q.z() == Approx(0).margin(1e-12));  // they head along x again
  }
  CHECK(score::aligned(turned, line, score::Alignment::none).pose[2].t == turned.pose[2].t);
}

TEST_CASE("trajectory errors worked out by hand", "[score]") {
  const score::Trajectory line = flat({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  const score::Trajectory bent = flat({{0, 0, 0}, {1, 0, 0}, {2, 3, 0}});
  const auto plain = score::trajectory_error(bent, line, score::Alignment::none);
  CHECK(plain.matched == 3);
  CHECK(*plain.ate == Approx(std::sqrt(9.0 / 3)));
  CHECK(*plain.rpe == Approx(std::sqrt(9.0 / 2)));  // errors of the two steps: 0 and (0, 3)

  // Turned by 90 degrees and moved; the relative motions are the same.
  const score::Trajectory moved = flat({{5, 1, pi / 2}, {5, 2, pi / 2}, {5, 3, pi / 2}});
  CHECK(*score::trajectory_error(moved, line, score::Alignment::se).ate == Approx(0).margin(1e-12));
  CHECK(*score::trajectory_error(moved, line, score::Alignment::none).rpe ==
        Approx(0).margin(1e-12));
  // Distances to the line: (5,1) (4,2) (3,3).
  CHECK(*score::trajectory_error(moved, line, score::Alignment::none).ate ==
        Approx(std::sqrt((26 + 20 + 18) / 3.0)));

  // A cross stretched in x: by symmetry the best rotation is none.
  const score::Trajectory cross = flat({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}});
  const score::Trajectory wide = flat({{2, 0, 0}, {-2, 0, 0}, {0, 1, 0}, {0, -1, 0}});
  CHECK(*score::trajectory_error(wide, cross, score::Alignment::se).ate == Approx(std::sqrt(0.5)));
  // Scale 6/10: residuals 0.2, 0.2, 0.4, 0.4.
  CHECK(*score::trajectory_error(wide, cross, score::Alignment::sim).ate == Approx(std::sqrt(0.1)));
  // Steps of the wide one, scaled: (-2.4, 0), (1.2, 0.6), (0, -1.2); of the cross: (-2, 0), (1, 1),
  // (0, -2). Differences squared: 0.16, 0.04 + 0.16, 0.64.
  CHECK(*score::trajectory_error(wide, cross, score::Alignment::sim).rpe ==
        Approx(std::sqrt(1.0 / 3)));
}

TEST_CASE("alignment undoes any similarity, in the plane and in space", "[score]") {
  Random random(3);
  for (int trial = 0; trial < 40; ++trial) {
    const bool planar = trial % 2 == 0;
    const auto any = [&] {
      Vector6d v = Vector6d::NullaryExpr([&] { return uniform(random, -1.5, 1.5); });
      if (planar) v[2] = v[3] = v[4] = 0;
      return geometry::exp(v);
    };
    score::Trajectory reference, estimate;
    const SE3 motion = any();
    const double scale = trial % 4 < 2 ? 1 : 2.5;
    for (Id id = 0; id < 6; ++id) {
      reference.id.push_back(id);
      reference.pose.push_back(any());
      estimate.id.push_back(id);
      estimate.pose.push_back(compose(motion, reference.pose.back()));
      estimate.pose.back().t *= scale;
    }
    const score::Alignment kind = scale == 1 ? score::Alignment::se : score::Alignment::sim;
    const auto error = score::trajectory_error(estimate, reference, kind);
    CHECK(*error.ate < 1e-9);
    CHECK(*error.rpe < 1e-9);
  }
}

TEST_CASE("poses are matched by id", "[score]") {
  score::Trajectory sparse = flat({{0, 0, 0}, {2, 0, 0}});
  sparse.id = {0, 2};
  const score::Trajectory line = flat({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}});
  const auto error = score::trajectory_error(sparse, line, score::Alignment::se);
  CHECK(error.matched == 2);
  CHECK(*error.ate == Approx(0).margin(1e-12));
  CHECK(*error.rpe == Approx(0).margin(1e-12));
  sparse.id = {7, 9};
  CHECK(score::trajectory_error(sparse, line, score::Alignment::sim).matched == 0);
  CHECK(!score::trajectory_error(sparse, line, score::Alignment::sim).ate);
  sparse.id = {3, 9};
  for (const score::Alignment kind :
       {score::Alignment::none, score::Alignment::se, score::Alignment::sim}) {
    CHECK(score::trajectory_error(sparse, line, kind).ate.has_value());
    CHECK(!score::trajectory_error(sparse, line, kind).rpe);
  }
  CHECK(*score::trajectory_error(sparse, line, score::Alignment::sim).ate ==
        Approx(0).margin(1e-12));
}

TEST_CASE("trajectories come from graphs and from TUM files", "[score]") {
  const Graph graph = graph_of("VERTEX_SE2 4 1 2 0.5\nVERTEX_XY 5 0 0\n");
  const score::Trajectory planar = score::trajectory(graph);
  REQUIRE(planar.id == std::vector<Id>{4});
  CHECK(planar.pose[0].t == Eigen::Vector3d(1, 2, 0));
  CHECK(geometry::log_so3(planar.pose[0].q).z() == Approx(0.5));
  const score::Trajectory composed =
      score::trajectory(graph_of("EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n"));
  CHECK(composed.pose[1].t == Eigen::Vector3d(1, 0, 0));

  const auto read = [](const std::string& text) {
    return score::trajectory(formats::read_graph_text(text::text_of(text), "t"));
  };
  // Exact above 2^53, too.
  const auto tum =
      read("7.000 1 2 3 0 0 0 1\r\n# x\n2 4 5 6 0 0 0 1\n9007199254740993 0 0 0 0 0 0 1");
  CHECK(tum.id == std::vector<Id>{2, 7, 9007199254740993});
  CHECK(tum.pose[1].t == Eigen::Vector3d(1, 2, 3));
  for (const auto* wrong :
       {"1.5 1 2 3 0 0 0 1\n", "-1 1 2 3 0 0 0 1\n", "1 1 2 3 0 0 0 0\n", "1 1 2 nan 0 0 0 1\n",
        "1 1 2 3 0 0 0 1\n1 1 2 3 0 0 0 1\n", "1 1 2 3 0 0 0 1\n2 1 2 3 0 0 0\n"})
    CHECK_THROWS_AS(read(wrong), text::Error);
  const auto kitti = read("1 0 0 5 0 1 0 6 0 0 1 7\n\n0 -1 0 1 1 0 0 2 0 0 1 3\n");
  CHECK(kitti.id == std::vector<Id>{0, 1});
  CHECK(kitti.pose[0].t == Eigen::Vector3d(5, 6, 7));
  CHECK(geometry::log_so3(kitti.pose[1].q).z() == Approx(M_PI / 2));
  for (const auto* wrong :
       {"1 0 0 5 0 1 0 6 0 0 2 7\n", "1 0 0 5 0 1 0 6 0 0 -1 7\n", "1 0 0 5 0 1 0 6 0 0 1 inf\n",
        "1 0 0 5 0 1 0 6 0 0 1 7\n1 0 0 5 0 1 0 6 0 0 1\n"})
    CHECK_THROWS_AS(read(wrong), text::Error);
}
