// Starts: exact where there is no noise, the relaxation against dense algebra, and the best of several.
#include "lib/solve/start.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>

#include "formats/formats.h"
#include "lib/factor/gauge.h"
#include "lib/factor/initialize.h"
#include "lib/factor/linearize.h"
#include "lib/factor/motion.h"
#include "lib/geometry/numbers.h"
#include "lib/graph/components.h"
#include "lib/order/order.h"
#include "lib/solve/best_start.h"
#include "lib/solve/chordal.h"
#include "lib/solve/places.h"
#include "lib/text/words.h"
#include "lib/world/manhattan.h"
#include "tests/unit/common.h"

using namespace sg;
using namespace sg::test;

namespace {

Eigen::Quaterniond any_rotation(Random& random) {
  const Eigen::Vector4d q(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1),
                          uniform(random, -1, 1));
  return Eigen::Quaterniond(Eigen::Vector4d(q.normalized()));
}

Eigen::Vector3d any_place(Random& random, double most) {
  return {uniform(random, -most, most), uniform(random, -most, most), uniform(random, -most, most)};
}

SE3 small_motion(Random& random, double size) {
  return {geometry::exp_so3(any_place(random, size)), any_place(random, size)};
}

SE3 planar(const SE3& a) {
  const double yaw = geometry::log_so3(a.q).z();
  return {geometry::exp_so3({0, 0, yaw}), {a.t.x(), a.t.y(), 0}};
}

// A kind of graph: tags, how a motion and a point are written.
struct Kind {
  std::string name, pose_edge, point_edge;
  bool plane;
};
const std::vector<Kind> kinds{
    {"se2", "EDGE_SE2", "EDGE_SE2_XY", true},
    {"se3", "EDGE_SE3:QUAT", "EDGE_SE3_TRACKXYZ", false},
    {"expmap", "EDGE_SE3:EXPMAP", "", false},
};

std::string information(Random& random, int dim) {
  std::string text;
  for (int i = 0; i < dim; ++i) {
    for (int j = i; j < dim; ++j) text += i == j ? " " + std::to_string(draw(random, 1, 9)) : " 0";
  }
  return text + "\n";
}

std::string numbers(const Kind& kind, const SE3& a) {
  std::string text;
  if (kind.plane) {
    for (const double number : {a.t.x(), a.t.y(), geometry::log_so3(a.q).z()})
      text += " " + text::format_number(number);
  } else {
    for (const double number : geometry::numbers_of(a)) text += " " + text::format_number(number);
  }
  return text;
}

struct Scene {
  std::string text;  // edges alone
  std::vector<SE3> pose;
  std::vector<Eigen::Vector3d> point;
};

// Poses anywhere, turned anyhow, pose 0 at the origin; every one is joined to some before it, not always to the last.
// Points are seen from two poses or more.
Scene random_scene(Random& random, const Kind& kind, int poses, int points, double noise) {
  Scene scene;
  for (int k = 0; k < poses; ++k) {
    const SE3 pose{any_rotation(random), any_place(random, 10)};
    scene.pose.push_back(k == 0 ? SE3{} : kind.plane ? planar(pose) : pose);
  }
  if (!kind.plane) scene.text += "PARAMS_SE3OFFSET 0 0 0 0 0 0 0 1\n";
  const auto measured = [&](const SE3& exact) {
    const SE3 seen = compose(exact, small_motion(random, noise));
    return kind.plane ? planar(seen) : seen;
  };
  const auto join = [&](int i, int j) {
    const SE3 z = measured(between(scene.pose[i], scene.pose[j]));
    scene.text += kind.pose_edge + " " + std::to_string(i) + " " + std::to_string(j) +
                  numbers(kind, z) + information(random, kind.plane ? 3 : 6);
  };
  for (int j = 1; j < poses; ++j) {
    join(draw(random, 0, j - 1), j);
    if (draw(random, 0, 2) > 0) join(draw(random, 0, j - 1), j);
  }
  for (int p = 0; p < points && !kind.point_edge.empty(); ++p) {
    Eigen::Vector3d point = any_place(random, 10);
    if (kind.plane) point.z() = 0;
    scene.point.push_back(point);
    for (int k = 0; k < 3; ++k) {
      const int i = draw(random, 0, poses - 1);
      const Eigen::Vector3d z = act(inverse(scene.pose[i]), point) + any_place(random, noise);
      scene.text += kind.point_edge + " " + std::to_string(i) + " " + std::to_string(1000 + p) +
                    (kind.plane ? "" : " 0");
      for (int c = 0; c < (kind.plane ? 2 : 3); ++c) scene.text += " " + text::format_number(z[c]);
      scene.text += information(random, kind.plane ? 2 : 3);
    }
  }
  return scene;
}

// The relaxation in dense algebra: rows of the least squares problem as they stand in the header, by QR.
struct Dense {
  int d;
  std::vector<std::pair<Eigen::RowVectorXd, Eigen::RowVectorXd>> rows;  // a, b
};

Eigen::MatrixXd nearest(const Eigen::MatrixXd& M) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::VectorXd sign = Eigen::VectorXd::Ones(M.rows());
  sign[M.rows() - 1] = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  return svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
}

Eigen::MatrixXd least_squares(const Dense& dense, int n) {
  const auto m = static_cast<int>(dense.rows.size());
  Eigen::MatrixXd A(m, n), B(m, dense.d);
  for (int k = 0; k < m; ++k) {
    A.row(k) = dense.rows[k].first;
    B.row(k) = dense.rows[k].second;
  }
  return A.colPivHouseholderQr().solve(B);  // n x d: [R t]' of every vertex, one below the other
}

// Of a graph whose first vertex is a pose at the origin and stays.
std::vector<Eigen::MatrixXd> dense_rotations(const factor::Problem& problem, int d) {
  const Graph& graph = *problem.graph;
  const int n = (d + 1) * graph.vertices();
  Dense dense{d, {}};
  const auto unit = [&](Index v, int c) {
    return Eigen::RowVectorXd(Eigen::RowVectorXd::Unit(n, (d + 1) * v + c));
  };
  const auto add = [&](double w, const Eigen::RowVectorXd& a, const Eigen::RowVectorXd& b) {
    dense.rows.emplace_back(std::sqrt(w) * a, std::sqrt(w) * b);
  };
  const Eigen::RowVectorXd zero = Eigen::RowVectorXd::Zero(d);
  const double hold = 1e8;  // of what stays, and of what landmarks have no use for
  for (int c = 0; c <= d; ++c)
    add(hold, unit(0, c), c < d ? Eigen::RowVectorXd(Eigen::RowVectorXd::Unit(d, c)) : zero);
  std::vector<double> sum(graph.vertices(), 0), count(graph.vertices(), 0);
  for (Index v = 0; v < graph.vertices(); ++v) {
    for (int c = 0; c < d && graph.role(v) != graph::Role::pose; ++c) add(1, unit(v, c), zero);
  }
  for (Index e = 0; e < graph.edges(); ++e) {
    const Index i = graph.edge(e)[0], j = graph.edge(e)[1];
    const factor::Motion motion = *factor::measured_motion(problem, e);
    Eigen::RowVectorXd place = unit(j, d) - unit(i, d);
    for (int c = 0; c < d; ++c) place -= motion.t[c] * unit(i, c);
    add(motion.place_information, place, zero);
    if (graph.role(j) != graph::Role::pose) continue;
    for (int a = 0; a < d; ++a) {
      Eigen::RowVectorXd turn = unit(j, a);
      for (int c = 0; c < d; ++c) turn -= motion.R(c, a) * unit(i, c);
      add(motion.turn_information / 2, turn, zero);
    }
    for (Index v : {i, j}) sum[v] += motion.turn_information, count[v] += 1;
  }
  std::vector<Eigen::MatrixXd> R(graph.vertices());
  const auto project = [&](const Eigen::MatrixXd& x) {
    double change = 0, poses = 0;
    for (Index v = 0; v < graph.vertices(); ++v) {
      if (graph.role(v) != graph::Role::pose) continue;
      const Eigen::MatrixXd next = nearest(x.middleRows((d + 1) * v, d).transpose());
      if (R[v].size() > 0 && v > 0) change += (next - R[v]).squaredNorm(), ++poses;
      R[v] = next;
    }
    return poses > 0 ? change / poses : 1;
  };
  project(least_squares(dense, n));
  const std::size_t edges = dense.rows.size();
  for (int round = 0; round < solve::most_rounds; ++round) {
    dense.rows.resize(edges);
    for (Index v = 1; v < graph.vertices(); ++v) {
      for (int c = 0; c < d && count[v] > 0; ++c)
        add(solve::pull * sum[v] / count[v], unit(v, c), R[v].col(c).transpose());
    }
    if (project(least_squares(dense, n)) < solve::settled * solve::settled) break;
  }
  return R;
}

std::string noisy_text(const world::Manhattan& world) {
  std::string text;
  world::Out out{[&](std::string_view piece) { text += piece; }};
  write_graph(world::manhattan(world), world::Copy::noisy, out);
  world::flush(out);
  return text;
}

struct Optimized {
  double chi2;
  int iterations;
  factor::Values values;
  std::vector<std::string> tried;
  std::vector<int> rows;  // of each that was tried
};

Optimized optimize(const factor::Problem& problem, std::vector<solve::Candidate> starts,
                   const solve::BatchOptions& options = {}) {
  factor::LinearSystem system = factor::make_linear_system(problem);
  const auto solver = solve::find_backend("tree").make(
      system, order::elimination_order("colamd", problem.variables.pattern, {}), 1);
  Optimized result{0, 0, {}, {}, {}};
  const solve::BatchResult end = solve::optimize_from_best(
      problem, system, solver, options, std::move(starts), true, result.values,
      [&](std::string_view start, double, int) {
        result.tried.emplace_back(start);
        result.rows.push_back(0);
      },
      [&](const solve::Iteration&) { ++result.rows.back(); });
  result.chi2 = end.chi2;
  result.iterations = end.iterations;
  return result;
}

}  // namespace

TEST_CASE("a measured motion is where an edge places its second end", "[start]") {
  Random random(1);
  int tested = 0;
  for (const char* name : {"types-se2.g2o", "types-se3.g2o", "types-expmap.g2o"}) {
    const Graph graph = test_graph(name);
    const factor::Problem problem = factor::make_problem(graph);
    factor::Values values = factor::file_values(problem);
    for (Index e = 0; e < graph.edges(); ++e) {
      const auto motion = factor::measured_motion(problem, e);
      if (!motion) continue;
      ++tested;
      const auto ends = graph.edge(e);
      const Index i = ends.front(), j = ends.back();
      const bool alone = ends.size() == 1;
      const bool turned = !alone && graph.role(i) == graph::Role::pose;
      const Eigen::Matrix3d R =
          turned ? factor::rotation(problem, values, i) : Eigen::Matrix3d::Identity();
      const Eigen::Vector3d t =
          alone ? Eigen::Vector3d(0, 0, 0) : factor::translation(problem, values, i);
      factor::Values placed = values;
      std::vector<bool> known(graph.vertices(), true);
      known[j] = false;
      REQUIRE(factor::place_vertex(problem, j, std::array{e}, known, placed));
      CHECK((factor::translation(problem, placed, j) - t - R * motion->t).norm() < 1e-6);
      if (motion->turn_information > 0)
        CHECK((factor::rotation(problem, placed, j) - R * motion->R).norm() < 1e-6);
      // Turning the end by a little costs what the information says, on average over the axes.
      if (graph.role(j) != graph::Role::pose || motion->turn_information == 0) continue;
      const double h = 1e-4;
      double sum = 0;
      const int axes = problem.space[j] == graph::Space::se2 ? 1 : 3;
      for (int axis = 3 - axes; axis < 3; ++axis) {
        factor::Values other = placed;
        const Eigen::Matrix3d turn =
            geometry::exp_so3(h * Eigen::Vector3d::Unit(axis)).toRotationMatrix();
        factor::set_rotation(problem, j, factor::rotation(problem, placed, j) * turn, other);
        sum += factor::edge_chi2(problem, other, e) / (h * h) / axes;
      }
      if (graph.type_of_edge(e).params.size == 0 && problem.space[j] != graph::Space::expmap)
        CHECK(motion->turn_information == Approx(sum).epsilon(1e-2));
    }
  }
  CHECK(tested > 40);
}

TEST_CASE("the chordal start of measurements without noise is the truth", "[start]") {
  Random random(2);
  for (const Kind& kind : kinds) {
    for (int trial = 0; trial < 10; ++trial) {
      const Scene scene = random_scene(random, kind, draw(random, 2, 40), draw(random, 0, 10), 0);
      const Graph graph = graph_of(scene.text);
      const factor::Problem problem = factor::make_problem(graph);
      const factor::Values values = solve::chordal_start(problem);
      CHECK(factor::chi2(problem, values) < 1e-16);
      for (Index v = 0; v < graph.vertices(); ++v) {
        const Id id = graph.id[v];
        const Eigen::Vector3d t = id < 1000 ? scene.pose[id].t : scene.point[id - 1000];
        CHECK((factor::translation(problem, values, v) - t).norm() < 1e-8);
        if (id < 1000)
          CHECK(
              (factor::rotation(problem, values, v) - scene.pose[id].q.toRotationMatrix()).norm() <
              1e-8);
      }
    }
  }
}

TEST_CASE("the relaxation is that of dense algebra", "[start]") {
  Random random(3);
  for (const Kind& kind : kinds) {
    for (int trial = 0; trial < 8; ++trial) {
      const Scene scene = random_scene(random, kind, draw(random, 2, 12), draw(random, 0, 4), 0.3);
      const Graph graph = graph_of(scene.text);
      const factor::Problem problem = factor::make_problem(graph);
      factor::Values values = factor::initial_values(problem);
      solve::relax_rotations(problem, values);
      const int d = kind.plane ? 2 : 3;
      const auto expected = dense_rotations(problem, d);
      for (Index v = 1; v < graph.vertices(); ++v) {
        if (graph.role(v) != graph::Role::pose) continue;
        const Eigen::MatrixXd R = factor::rotation(problem, values, v).topLeftCorner(d, d);
        CHECK((R - expected[v]).norm() < 1e-5);
      }
    }
  }
}

TEST_CASE("places are the best that these rotations have", "[start]") {
  Random random(4);
  for (const Kind& kind : kinds) {
    for (int trial = 0; trial < 5; ++trial) {
      const Scene scene = random_scene(random, kind, draw(random, 2, 20), draw(random, 0, 6), 0.2);
      const Graph graph = graph_of(scene.text);
      const factor::Problem problem = factor::make_problem(graph);
      factor::Values values = factor::initial_values(problem);
      const factor::Values before = values;
      std::vector<bool> placed(graph.vertices(), false);
      solve::solve_places(problem, placed, values);
      factor::LinearSystem system = factor::make_linear_system(problem);
      factor::linearize(problem, values, {}, system);
      std::vector<double> slope(problem.step_at.back(), 0);
      for (Index e = 0; e < graph.edges(); ++e) {
        const int height = system.height[e];
        const double* column = system.block(e);
        const double* b = system.block(e + 1) - height;
        for (Index j : problem.variables.pattern.rows[e]) {
          for (Index k = problem.step_at[j]; k < problem.step_at[j + 1]; ++k, column += height) {
            for (int i = 0; i < height; ++i) slope[k] += column[i] * b[i];
          }
        }
      }
      for (Index v = 0; v < graph.vertices(); ++v) {
        CHECK(placed[v]);
        const Index j = problem.variables.vertex_variable[v];
        const graph::Axes axes = graph::facts(problem.space[v]).translation;
        for (int k = 0; k < axes.size; ++k)
          CHECK(std::abs(slope[problem.step_at[j] + axes.first + k]) < 1e-7);
        CHECK((factor::rotation(problem, values, v) - factor::rotation(problem, before, v)).norm() <
              1e-12);
      }
      CHECK(factor::translation(problem, values, 0).norm() == 0);
    }
  }
}

TEST_CASE("what nothing joins to the rest, or holds, stays where it is", "[start]") {
  // Two parts; the second with a landmark that no edge tells the distance of.
  const Graph graph = graph_of(
      "VERTEX_SE2 0 5 6 1\nVERTEX_SE2 1 0 0 0\nVERTEX_SE2 2 7 8 2\nVERTEX_SE2 3 0 0 0\n"
      "VERTEX_XY 4 1 1\nEDGE_SE2 0 1 1 0 0.5 1 0 0 1 0 1\nEDGE_SE2 2 3 0 2 -0.5 1 0 0 1 0 1\n"
      "EDGE_SE2_XY 3 4 2 0 0 0 1\n");
  const factor::Problem problem = factor::make_problem(graph);
  const factor::Values values = solve::chordal_start(problem);
  CHECK(factor::chi2(problem, values) < 1e-12);
  CHECK(factor::rotation(problem, values, 0)(1, 0) == Approx(std::sin(1)));
  CHECK((factor::translation(problem, values, 0) - Eigen::Vector3d(5, 6, 0)).norm() == 0);
  CHECK((factor::translation(problem, values, 2) - Eigen::Vector3d(7, 8, 0)).norm() == 0);
  for (const double x : values) CHECK(std::isfinite(x));
}

TEST_CASE("the tree takes the way of least variance", "[start]") {
  // 0-1-2-3 along poor odometry; 0-4-3 by good edges: 3 comes by 4, 2 by 3.
  const auto edge = [](int i, int j, double turn, double information) {
    return "EDGE_SE2 " + std::to_string(i) + " " + std::to_string(j) + " 1 0 " +
           std::to_string(turn) + " 1 0 0 1 0 " + std::to_string(information) + "\n";
  };
  const Graph graph = graph_of(edge(0, 1, 0.1, 1) + edge(1, 2, 0.1, 1) + edge(2, 3, 0.1, 2) +
                               edge(0, 4, 0.5, 100) + edge(4, 3, 0.5, 100));
  const factor::Problem problem = factor::make_problem(graph);
  const factor::Values values = solve::tree_start(problem);
  const auto angle = [&](Index v) { return values[problem.value_at[v] + 2]; };
  CHECK(angle(1) == Approx(0.1));
  CHECK(angle(3) == Approx(1));
  CHECK(angle(2) == Approx(0.9));
  CHECK(factor::edge_chi2(problem, values, 1) > 0.1);
}

TEST_CASE("a tree of n poses leaves n - 1 edges without an error", "[start]") {
  Random random(5);
  for (const Kind& kind : kinds) {
    const Scene scene = random_scene(random, kind, 30, 5, 0.3);
    const Graph graph = graph_of(scene.text);
    const factor::Problem problem = factor::make_problem(graph);
    const factor::Values values = solve::tree_start(problem);
    int exact = 0;
    for (Index e = 0; e < graph.edges(); ++e) {
      exact += graph.role(graph.edge(e)[1]) == graph::Role::pose &&
               factor::edge_chi2(problem, values, e) < 1e-16;
    }
    CHECK(exact == 29);
  }
}

TEST_CASE("every start of an easy graph leads to one optimum, and an unknown one is told",
          "[start]") {
  for (const char* name : {"types-se2.g2o", "types-se3.g2o", "walk.g2o"}) {
    const Graph graph = test_graph(name);
    const factor::Problem problem = factor::make_problem(graph);
    std::vector<double> ends;
    for (const solve::Start& start : solve::starts()) {
      std::vector<solve::Candidate> one;
      one.push_back(solve::make_candidate(problem, start.name, {}));
      ends.push_back(optimize(problem, std::move(one)).chi2);
    }
    for (const double end : ends) CHECK(end == Approx(ends[0]).epsilon(1e-6).margin(1e-15));
  }
  CHECK_THROWS_WITH(solve::find_start("chordial"), Catch::Contains("chordal"));
}

TEST_CASE("the best start is the first, and the others are for ends that noise does not explain",
          "[start]") {
  // Noise of 0.2 rad: composed odometry ends far off.
  world::Manhattan world;
  world.poses = 400;
  world.noise.rotation = 0.2;
  const Graph graph = graph_of(noisy_text(world));
  const factor::Problem problem = factor::make_problem(graph);
  auto starts = solve::default_candidates(problem, {});
  REQUIRE(starts.size() == 2);
  CHECK(starts[0].name == "chordal");
  CHECK(starts[1].name == "file");
  CHECK(starts[0].chi2 < starts[1].chi2);
  std::vector<solve::Candidate> file{starts[1]}, chordal{starts[0]};
  const Optimized best = optimize(problem, starts);
  CHECK(best.tried == std::vector<std::string>{"chordal"});
  CHECK(best.chi2 == Approx(factor::chi2(problem, best.values)));

  // From the file alone the tree is tried, too; the better end is kept.
  const Optimized other = optimize(problem, file);
  CHECK(other.tried == std::vector<std::string>{"file", "tree", "file"});
  CHECK(other.chi2 == Approx(factor::chi2(problem, other.values)));

  // The worse start first: the chordal one takes over.
  const Optimized turned = optimize(problem, {file[0], chordal[0]});
  CHECK(turned.tried == std::vector<std::string>{"file", "chordal", "tree"});
  CHECK(turned.chi2 == Approx(best.chi2).epsilon(1e-6));

  // Gauss-Newton diverges from the file; with nothing else left, that is told.
  solve::BatchOptions newton;
  newton.method = solve::BatchMethod::gauss_newton;
  CHECK(optimize(problem, {file[0], chordal[0]}, newton).chi2 == Approx(best.chi2).epsilon(1e-6));
}

TEST_CASE("a start that stays far above the best is given up", "[start]") {
  // Little noise, and a false closure, so that noise does not explain the best end.
  Random random(8);
  world::Manhattan world;
  world.poses = 1000;
  const Graph graph = graph_of(noisy_text(world) + "EDGE_SE2 10 200 0 0 1 10 0 0 10 0 10\n");
  const factor::Problem problem = factor::make_problem(graph);
  solve::Candidate good = solve::make_candidate(problem, "chordal", {});
  solve::Candidate bad = good;
  bad.name = "file";
  for (Index v = 1; v < graph.vertices(); ++v) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(draw(random, 0, 628) / 100.0, Eigen::Vector3d::UnitZ())
            .toRotationMatrix();
    factor::set_rotation(problem, v, turn, bad.values);
  }
  bad.chi2 = factor::chi2(problem, bad.values);
  const Optimized end = optimize(problem, {good, bad});
  CHECK(end.tried == std::vector<std::string>{"chordal", "file", "tree", "chordal"});
  CHECK(end.rows[1] == 5);
  CHECK(end.rows[2] != 5);
  CHECK(end.chi2 < good.chi2);
}
