// Bundle adjustment in the large, from its text to its optimum, beside a projection of the test's own.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "formats/convert.h"
#include "formats/formats.h"
#include "lib/elim/score.h"
#include "lib/factor/edge_bal.h"
#include "lib/factor/initialize.h"
#include "lib/factor/linearize.h"
#include "lib/order/order.h"
#include "lib/solve/batch.h"
#include "lib/text/words.h"
#include "tests/unit/common.h"

using namespace sg;

namespace {

using Camera = std::array<double, 9>;

// As the format's page has it.
Eigen::Vector2d pixel(const Camera& camera, const Eigen::Vector3d& point) {
  const Eigen::Map<const Eigen::Vector3d> w(camera.data()), t(camera.data() + 3);
  const Eigen::Vector3d P = Eigen::AngleAxisd(w.norm(), w.normalized()) * point + t;
  const Eigen::Vector2d p(-P.x() / P.z(), -P.y() / P.z());
  const double n = p.squaredNorm();
  return camera[6] * (1 + camera[7] * n + camera[8] * n * n) * p;
}

struct Bundle {
  std::vector<Camera> cameras;
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 2>> seen;

  // Pixels without noise, estimates that are `off` by that much at most, a focal length by a thousand times that.
  std::string text(test::Random& random, double off) const {
    std::string out = std::to_string(cameras.size()) + " " + std::to_string(points.size()) + " " +
                      std::to_string(seen.size()) + "\n";
    for (const auto& [i, j] : seen) {
      const Eigen::Vector2d z = pixel(cameras[i], points[j]);
      out += std::to_string(i) + " " + std::to_string(j) + "    ";
      text::append_numbers(out, {z.data(), 2});
      out += "\n";
    }
    const auto line = [&](double number, double unit) {
      out += text::format_number(number + unit * test::uniform(random, -off, off)) + "\n";
    };
    for (const Camera& camera : cameras) {
      for (int k = 0; k < 9; ++k) line(camera[k], k == 6 ? 1000 : 1);
    }
    for (const Eigen::Vector3d& point : points) {
      for (const double number : point) line(number, 1);
    }
    return out;
  }
};

// Points about the origin, cameras five from it that look at them; every point is seen by three or more.
Bundle draw_bundle(test::Random& random, int cameras, int points) {
  const auto near = [&](double most) { return test::uniform(random, -most, most); };
  Bundle bundle;
  for (int i = 0; i < cameras; ++i)
    bundle.cameras.push_back({near(0.3), near(0.6), near(3), near(0.5), near(0.5), -5 + near(0.5),
                              test::uniform(random, 400, 800), near(0.1), near(0.05)});
  for (int j = 0; j < points; ++j) bundle.points.emplace_back(near(1.5), near(1.5), near(1.5));
  for (int j = 0; j < points; ++j) {
    const int blind = test::draw(random, 0, cameras > 3 ? cameras : 0);
    for (int i = 0; i < cameras; ++i) {
      if (i != blind || cameras <= 3) bundle.seen.push_back({i, j});
    }
  }
  return bundle;
}

Graph graph_of(const std::string& text) {
  return formats::read_graph_text(text::text_of(text), "test");
}

double chi2_of(const Graph& graph) {
  const factor::Problem problem = factor::make_problem(graph);
  return factor::chi2(problem, factor::start_values(problem));
}

std::string written(const Graph& graph) {
  test::StringSink sink;
  formats::find_write_format("bal").write(graph, {}, sink);
  return sink.text;
}

std::vector<std::string> complaints_of(const std::string& text) {
  std::vector<std::string> messages;
  formats::ReadOptions options;
  options.format = "bal";
  options.complaint = [&](const text::Error& error) { messages.push_back(text::message(error)); };
  formats::read_graph_text(text::text_of(text), "test", options);
  return messages;
}

const std::string small =  // two cameras and one point, camera 1 turned by pi / 2 about z
    "2 1 2\n0 0 50 -25\n1 0 25 50\n0\n0\n0\n0\n0\n0\n100\n0\n0\n"
    "0 0 1.5707963267948966\n0 0 0\n100 0.1 0.01\n-1 0.5 -2\n";

}  // namespace

TEST_CASE("BAL: a line of the file is a line of the graph", "[bal]") {
  const Graph graph = graph_of(small);
  CHECK(graph.id == std::vector<Id>{0, 1, 2});
  CHECK(graph.role(1) == graph::Role::pose);
  CHECK(graph.role(2) == graph::Role::landmark);
  CHECK(graph.dim(0) == 9);
  CHECK(graph.dim(2) == 3);
  CHECK(graph::line_at(graph, graph.edge_line[1]) == "EDGE_OBSERVATION_BAL 1 2 25 50 1 0 1");
  CHECK(graph::line_number(graph, graph.edge_line[1]) == 3);
  CHECK(graph::line_number(graph, graph.vertex_line[0]) == 12);
  CHECK(graph::line_number(graph, graph.vertex_line[1]) == 15);
  CHECK(graph::line_at(graph, graph.vertex_line[2]) == "VERTEX_XYZ 2 -1 0.5 -2");
  // p = (-0.5, 0.25) in camera 0; in camera 1 (-0.25, -0.5), times 1 + 0.1 * 0.3125 + 0.01 * 0.3125^2.
  const double r = 1 + 0.1 * 0.3125 + 0.01 * 0.3125 * 0.3125;
  CHECK(chi2_of(graph) ==
        Approx(100 * 100 + 50 * 50 + std::pow(25 * r + 25, 2) + std::pow(50 * r + 50, 2)));
}

TEST_CASE("BAL: what is wrong with a file is said with its line", "[bal]") {
  const auto message = [](const std::string& from, const std::string& to) {
    std::string text = small;
    text.replace(text.find(from), from.size(), to);
    const auto all = complaints_of(text);
    return all.empty() ? "" : all.front();
  };
  CHECK(message("1 0 25 50", "1 0 25 50") == "");
  CHECK(message("1 0 25 50", "2 0 25 50") ==
        "test:3: camera 2: there are no more than 2, counted from 0");
  CHECK(message("1 0 25 50", "1 1 25 50") ==
        "test:3: point 1: there are no more than 1, counted from 0");
  CHECK(message("1 0 25 50", "1 0 25") == "test:3: the line ends before its last number");
  CHECK(message("1 0 25 50", "1 0 25 50 7") == "test:3: '7' stands where the line should end");
  CHECK(message("1 0 25 50", "1 0 25 nan") == "test:3: a number is not finite");
  CHECK(message("100\n", "x\n") == "test:10: 'x' is not a number");
  CHECK(message("100 0.1 0.01", "100 0.1 0.01 7") ==
        "test:15: '7' stands where the line should end");
  CHECK(message("-1 0.5 -2", "-1 0.5") == "test:16: the file ends before point 1 of 1");
  CHECK(message("-1 0.5 -2\n", "-1 0.5 -2\n3\n") ==
        "test:17: the file goes on behind the last point");
  CHECK(message("2 1 2", "2 2 2") == "test:16: the file ends before point 2 of 2");
  CHECK(message("2 1 2", "2 1 -2") == "test:1: '-2' is not a number of observations");
  CHECK(message("2 1 2", "2 1 1000000") ==
        "test:1: the file is too short for what it says to hold: 2 cameras, 1 points, 1000000 "
        "observations");
  CHECK(complaints_of("2 1 2\n0 0 1 1\n") ==
        std::vector<std::string>{"test:2: the file ends before observation 2 of 2"});
  CHECK(complaints_of("1 0 0\n1 2 3\n4 5\n") ==
        std::vector<std::string>{"test:3: the file ends before camera 1 of 1"});
  CHECK(complaints_of("1 0\n1 2 3\n4 5\n").size() == 1);  // without counts nothing else makes sense
}

TEST_CASE("BAL is told by its content", "[bal]") {
  const auto format = [](const std::string& text) { return formats::find_format({}, text).name; };
  CHECK(format(small) == "bal");
  CHECK(format("2 1 2\r\n0 0 50 -25\r\n") == "bal");
  CHECK(format("\n1 0 0\n") == "bal");
  CHECK(format("2 1 2\n0.5 0 50 -25\n") != "bal");
  CHECK(format("2 1 2 1\n0 0 50 -25\n") != "bal");
  CHECK(format("0 0 0 0 0 0 0 1\n") == "tum");
}

TEST_CASE("BAL: pixels are those of its own projection, and come back", "[bal]") {
  int refused = 0;
  for (int seed = 1; seed <= 60; ++seed) {
    test::Random random(seed);
    INFO("seed " << seed);
    const Bundle bundle = draw_bundle(random, test::draw(random, 1, 6), test::draw(random, 1, 9));
    CHECK(chi2_of(graph_of(bundle.text(random, 0))) < 1e-18);
    const std::string text = bundle.text(random, 0.01);
    const Graph graph = graph_of(text);
    const Graph back = graph_of(written(graph));
    CHECK(back.id == graph.id);
    CHECK(back.vertex_type == graph.vertex_type);
    CHECK(back.edge_vertices.items == graph.edge_vertices.items);
    CHECK(chi2_of(back) == Approx(chi2_of(graph)).epsilon(1e-10));
    const auto pattern = graph::graph_pattern(graph).pattern;
    CHECK(elim::elimination_complexity(pattern, order::elimination_order("colamd", pattern)) ==
          elim::elimination_complexity(graph::graph_pattern(back).pattern,
                                       order::elimination_order("colamd", pattern)));
    // What it cannot hold.
    const auto losses = [&](const std::string& from, const std::string& to) {
      std::string changed(graph.text.view);
      changed.replace(changed.find(from), from.size(), to);
      const Graph read = graph_of(changed);
      int structure = 0;
      for (const auto& loss : formats::find_write_format("bal").losses(read)) {
        structure += loss.structure;
      }
      return structure;
    };
    CHECK(losses("VERTEX_XYZ", "VERTEX_XYZ") == 0);
    refused += losses(" 1 0 1\n", " 1 0 2\n");
    refused += losses("VERTEX_XYZ", "VERTEX_XYZ 1000 1 1 1\nVERTEX_XYZ");
    refused += losses("VERTEX_XYZ", "VERTEX_SE3:QUAT 1000 1 1 1 0 0 0 1\nVERTEX_XYZ");
  }
  CHECK(refused == 180);
}

TEST_CASE("BAL: rays meet where the points are", "[bal]") {
  for (int seed = 1; seed <= 20; ++seed) {
    test::Random random(seed);
    INFO("seed " << seed);
    const Graph graph = graph_of(draw_bundle(random, 4, 8).text(random, 0));
    const factor::Problem problem = factor::make_problem(graph);
    const factor::Values values = factor::file_values(problem);
    for (Index e = 0; e < graph.edges(); ++e) {
      const factor::Ray ray = factor::ray_of(problem, e, values);
      const double* const point = factor::ends_of(problem, values, e)[1];
      double ahead = 0;
      for (int i = 0; i < 3; ++i) ahead += ray.ahead[i] * (point[i] - ray.origin[i]);
      CHECK(ahead > 1);
      for (int k = 0; k < ray.rows; ++k) {
        double row = -ray.row[k][3];
        for (int i = 0; i < 3; ++i) row += ray.row[k][i] * point[i];
        CHECK(std::abs(row) < 1e-9);
      }
    }
  }
}

TEST_CASE("BAL: distortion is undone where it can be", "[bal]") {
  CHECK(factor::undistorted(0, 0.1, 0.1) == 0);
  CHECK(factor::undistorted(0.5 * (1 - 0.2 * 0.25 + 0.05 * 0.0625), -0.2, 0.05) == Approx(0.5));
  CHECK(factor::undistorted(2, -1, 0) == 2);  // nothing is seen there: r (1 - r^2) is 0.385 at most
}

TEST_CASE("BAL is solved, and the gauge holds a pose but no focal length", "[bal]") {
  for (int seed = 1; seed <= 6; ++seed) {
    test::Random random(seed);
    const Graph graph = graph_of(draw_bundle(random, 5, 20).text(random, 0.02));
    const factor::Problem problem = factor::make_problem(graph);
    REQUIRE(problem.held == 0);
    CHECK(factor::held_dim(problem) == 6);
    CHECK_FALSE(factor::is_held(problem, 0));
    factor::LinearSystem system = factor::make_linear_system(problem);
    factor::Values values = factor::file_values(problem);
    const factor::Values start = values;
    const auto order = order::elimination_order("colamd", problem.variables.pattern);
    for (const solve::Backend& backend : solve::backends()) {
      INFO("seed " << seed << " " << backend.name);
      values = start;
      const auto result =
          solve::optimize(problem, system, backend.make(system, order, 1), {}, values);
      CHECK(result.converged);
      CHECK(result.initial_chi2 > 100);
      CHECK(result.chi2 < 1e-12);
      for (int k = 0; k < 7; ++k) CHECK(values[k] == Approx(start[k]).margin(1e-9));
      CHECK(values[7] != Approx(start[7]).epsilon(1e-6));
    }
  }
}
