// The generators against independent arithmetic: 4x4 matrices and the error definitions of g2o's manual, written out
// once more. An exact graph has no residuals; of a noisy one the residuals at the truth are what its information
// matrices claim.
#include <Eigen/Dense>
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>
#include <sstream>

#include "formats/formats.h"
#include "lib/factor/initialize.h"
#include "lib/factor/linearize.h"
#include "lib/graph/replay.h"
#include "lib/world/city.h"
#include "lib/world/grid3d.h"
#include "lib/world/manhattan.h"
#include "lib/world/sine.h"
#include "lib/world/sphere.h"
#include "lib/world/torus.h"
#include "lib/world/worst.h"

using namespace sg;

namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using sg::Graph;
using sg::Index;
using sg::world::Copy;

template <class World>
std::string text_of_world(const World& world, Copy copy) {
  std::string text;
  sg::world::Out out{[&](std::string_view piece) { text += piece; }};
  write_graph(world, copy, out);
  world::flush(out);
  return text;
}

Graph read(std::string text) {
  return sg::formats::read_graph_text(sg::text::text_of(std::move(text)), "world");
}

MatrixXd planar_pose(double x, double y, double theta) {
  MatrixXd T = MatrixXd::Identity(3, 3);
  T << std::cos(theta), -std::sin(theta), x, std::sin(theta), std::cos(theta), y, 0, 0, 1;
  return T;
}

MatrixXd spatial_pose(const double* v) {
  MatrixXd T = MatrixXd::Identity(4, 4);
  const double x = v[3], y = v[4], z = v[5], w = v[6];
  REQUIRE(x * x + y * y + z * z + w * w == Approx(1).epsilon(1e-8));
  T.topLeftCorner(3, 3) << w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y),
      2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x), 2 * (x * z - w * y),
      2 * (y * z + w * x), w * w - x * x - y * y + z * z;
  T.topRightCorner(3, 1) << v[0], v[1], v[2];
  return T;
}

// The rotation vector of a rotation close to none; accurate to third order.
Vector3d small_rotation(const MatrixXd& T) {
  return Vector3d(T(2, 1) - T(1, 2), T(0, 2) - T(2, 0), T(1, 0) - T(0, 1)) / 2;
}

MatrixXd pose_matrix(const std::vector<double>& v) {
  return v.size() == 3 ? planar_pose(v[0], v[1], v[2]) : spatial_pose(v.data());
}

struct Camera {
  double fx, fy, cx, cy;
  MatrixXd offset;  // the camera in the frame of the pose
};

Camera camera_of(const Graph& graph) {
  std::vector<double> p;
  REQUIRE(graph.params.size() == 1);
  graph::param_numbers(graph, graph.params[0], p);
  if (p.size() == 4) return {p[0], p[0], p[1], p[2], MatrixXd::Identity(4, 4)};
  if (p.size() == 7) return {0, 0, 0, 0, spatial_pose(p.data())};
  REQUIRE(p.size() == 11);
  return {p[7], p[8], p[9], p[10], spatial_pose(p.data())};
}

// The error of a measurement, in the order in which its information matrix has it.
VectorXd error_of(const std::string& tag, const std::vector<double>& a,
                  const std::vector<double>& b, const std::vector<double>& z,
                  const Camera& camera) {
  const auto homogeneous = [](const std::vector<double>& p) {
    VectorXd h(p.size() + 1);
    for (std::size_t i = 0; i < p.size(); ++i) h[i] = p[i];
    h[p.size()] = 1;
    return h;
  };
  if (tag == "EDGE_SE2") {
    const MatrixXd d = (pose_matrix(a) * planar_pose(z[0], z[1], z[2])).inverse() * pose_matrix(b);
    return Vector3d(d(0, 2), d(1, 2), std::atan2(d(1, 0), d(0, 0)));
  }
  if (tag == "EDGE_SE3:QUAT" || tag == "EDGE_SE3:EXPMAP") {
    const MatrixXd A = pose_matrix(a), B = pose_matrix(b), Z = spatial_pose(z.data());
    VectorXd e(6);
    if (tag == "EDGE_SE3:QUAT") {
      const MatrixXd d = Z.inverse() * A.inverse() * B;
      e << d(0, 3), d(1, 3), d(2, 3), small_rotation(d) / 2;
    } else {  // world to world: B Z^-1 A^-1 of camera poses A, B; its logarithm, to second order
      const MatrixXd d = B * Z.inverse() * A.inverse();
      const Vector3d w = small_rotation(d), t = d.topRightCorner(3, 1);
      e << w, t - w.cross(t) / 2;
    }
    return e;
  }
  if (tag == "EDGE_PROJECT_XYZ2UV:EXPMAP") {  // the landmark comes first
    const VectorXd p = pose_matrix(b).inverse() * homogeneous(a);
    REQUIRE(p[2] > 0);
    return Eigen::Vector2d(z[0] - camera.fx * p[0] / p[2] - camera.cx,
                           z[1] - camera.fy * p[1] / p[2] - camera.cy);
  }
  const MatrixXd sensor = a.size() == 3 ? pose_matrix(a) : MatrixXd(pose_matrix(a) * camera.offset);
  const VectorXd p = sensor.inverse() * homogeneous(b);
  if (tag == "EDGE_SE2_XY") return Eigen::Vector2d(p[0] - z[0], p[1] - z[1]);
  if (tag == "EDGE_SE3_TRACKXYZ") return Vector3d(p[0] - z[0], p[1] - z[1], p[2] - z[2]);
  if (tag == "EDGE_BEARING_SE2_XY") {
    const double angle = std::atan2(p[1], p[0]) - z[0];
    return VectorXd::Constant(1, std::remainder(angle, 2 * std::acos(-1.0)));
  }
  REQUIRE(tag == "EDGE_PROJECT_DISPARITY");
  return Vector3d(camera.fx * p[0] / p[2] + camera.cx - z[0],
                  camera.fy * p[1] / p[2] + camera.cy - z[1], 1 / p[2] - z[2]);
}

MatrixXd information_of(const std::vector<double>& z, int dim) {
  MatrixXd W(dim, dim);
  auto at = z.end() - dim * (dim + 1) / 2;
  for (int i = 0; i < dim; ++i) {
    for (int j = i; j < dim; ++j) W(i, j) = W(j, i) = *at++;
  }
  return W;
}

struct ChiSquare {
  double sum = 0;
  int dof = 0;
};

// The residuals of `measured` at the estimates of `truth`, by tag.
std::map<std::string, ChiSquare> chi_squares(const Graph& truth, const Graph& measured) {
  Camera camera;
  if (!truth.params.empty()) camera = camera_of(truth);
  std::map<std::string, ChiSquare> result;
  std::vector<double> a, b, z;
  for (Index e = 0; e < measured.edges(); ++e) {
    const sg::graph::EdgeType& type = measured.type_of_edge(e);
    graph::vertex_numbers(truth, measured.edge(e)[0], a);
    graph::vertex_numbers(truth, measured.edge(e)[1], b);
    graph::edge_numbers(measured, e, z);
    const VectorXd error = error_of(type.tag, a, b, z, camera);
    const MatrixXd W = information_of(z, type.dim);
    REQUIRE(Eigen::LLT<MatrixXd>(W).info() == Eigen::Success);
    result[type.tag].sum += error.dot(W * error);
    result[type.tag].dof += type.dim;
  }
  return result;
}

template <class World>
void check_noise(const World& world) {
  const Graph truth = read(text_of_world(world, Copy::exact));
  const Graph noisy = read(text_of_world(world, Copy::noisy));
  REQUIRE(truth.id == noisy.id);
  REQUIRE(truth.edge_vertices.items == noisy.edge_vertices.items);
  for (const auto& [tag, exact] : chi_squares(truth, truth)) {
    INFO(tag);
    CHECK(exact.sum / exact.dof < 1e-6);
  }
  for (const auto& [tag, chi] : chi_squares(truth, noisy)) {
    INFO(tag << ": " << chi.sum << " of " << chi.dof);
    CHECK(std::abs(chi.sum - chi.dof) < 5 * std::sqrt(2.0 * chi.dof));
  }
}

std::map<std::string, int> count_tags(const Graph& graph) {
  std::map<std::string, int> count;
  for (Index v = 0; v < graph.vertices(); ++v) ++count[graph.type_of_vertex(v).tag];
  for (Index e = 0; e < graph.edges(); ++e) ++count[graph.type_of_edge(e).tag];
  return count;
}

// Odometry from every pose to the next is there, once; vertices are 0, 1, ... without a gap.
void check_spine(const Graph& graph, Index poses) {
  std::vector<int> odometry(poses);
  for (Index v = 0; v < graph.vertices(); ++v) REQUIRE(graph.id[v] == v);
  for (Index e = 0; e < graph.edges(); ++e) {
    const auto ends = graph.edge(e);
    REQUIRE(ends.size() == 2);
    const bool poses_only = graph.role(ends[0]) == sg::graph::Role::pose &&
                            graph.role(ends[1]) == sg::graph::Role::pose;
    if (poses_only && ends[1] == ends[0] + 1) ++odometry[ends[1]];
  }
  for (Index k = 1; k < poses; ++k) REQUIRE(odometry[k] == 1);
}

constexpr sg::world::Sensor sensors[] = {sg::world::Sensor::mono, sg::world::Sensor::xyz,
                                         sg::world::Sensor::disparity, sg::world::Sensor::xy,
                                         sg::world::Sensor::bearing};

}  // namespace

TEST_CASE("the noise of sine is what its information claims", "[world]") {
  for (const sg::world::Sensor sensor : sensors) {
    INFO("sensor " << static_cast<int>(sensor));
    sg::world::Sine world;
    world.poses = 150;
    world.sensor = sensor;
    check_noise(sg::world::sine(world));
  }
}

TEST_CASE("the noise of worst is what its information claims", "[world]") {
  for (const sg::world::Sensor sensor : sensors) {
    sg::world::Worst world;
    world.poses = 40;
    world.sensor = sensor;
    check_noise(sg::world::worst(world));
  }
}

TEST_CASE("a sine world's density follows its profile", "[world]") {
  sg::world::Sine world;
  world.poses = 4000;
  const auto thirds = [&](std::vector<double> profile) {
    world.profile = std::move(profile);
    const sg::world::LandmarkGraph graph = sg::world::sine(world);
    const double end = graph.poses.back().x;
    std::vector<int> count(3);
    for (const auto& l : graph.landmarks) {
      if (0 <= l.x() && l.x() < end) ++count[static_cast<std::size_t>(3 * l.x() / end)];
    }
    return count;
  };
  const std::vector<int> even = thirds({}), same = thirds({1}), uneven = thirds({1, 0, 0, 2});
  for (std::size_t k = 0; k < 3; ++k) CHECK(same[k] == Approx(even[k]).epsilon(0.15));
  CHECK(uneven[0] == Approx(0.5 * even[0]).epsilon(0.15));
  CHECK(uneven[1] == 0);
  CHECK(uneven[2] == Approx(even[2]).epsilon(0.15));
}

TEST_CASE("a world that no graph can hold is refused before it is made", "[world]") {
  sg::world::Sine dense;
  dense.density = 1e9;
  CHECK_THROWS_AS(sg::world::sine(dense), sg::text::Error);
  dense.density = 1e300;
  CHECK_THROWS_AS(sg::world::sine(dense), sg::text::Error);
  sg::world::Worst large;
  large.poses = large.landmarks = 100'000;
  CHECK_THROWS_AS(sg::world::worst(large), sg::text::Error);
}

TEST_CASE("the noise of the other worlds is what their information claims", "[world]") {
  check_noise(sg::world::manhattan({.poses = 1000}));
  check_noise(sg::world::city({.poses = 1000}));
  check_noise(sg::world::city({.poses = 1000, .sensor = sg::world::Sensor::bearing}));
  check_noise(sg::world::sphere({.poses = 400}));
  check_noise(sg::world::torus({.poses = 500}));
  check_noise(sg::world::grid3d({.poses = 343}));
  check_noise(sg::world::grid3d({.poses = 343, .walk = sg::world::GridWalk::random}));
}

TEST_CASE("sine lies in the regime of the paper", "[world]") {
  const sg::world::LandmarkGraph world = sg::world::sine({});
  const Graph graph = read(text_of_world(world, Copy::noisy));
  check_spine(graph, 400);
  auto count = count_tags(graph);
  CHECK(count["VERTEX_SE3:EXPMAP"] == 400);
  CHECK(count["EDGE_SE3:EXPMAP"] == 399);
  const int landmarks = count["VERTEX_TRACKXYZ"];
  const double observations = count["EDGE_PROJECT_XYZ2UV:EXPMAP"];
  CHECK(landmarks == Approx(440).epsilon(0.08));
  CHECK(observations / 400 == Approx(50).epsilon(0.1));
  std::vector<int> seen(landmarks);
  for (const Index l : world.seen.items) ++seen[l];
  CHECK(*std::min_element(seen.begin(), seen.end()) >= 3);
}

TEST_CASE("sine keeps what a sensor sees, and its path its step", "[world]") {
  sg::world::Sine world;
  world.poses = 200;
  world.sensor = sg::world::Sensor::xyz;
  world.landmark.observations = 1;
  const sg::world::LandmarkGraph graph = sg::world::sine(world);
  std::size_t observations = 0;
  for (std::size_t k = 0; k < graph.poses.size(); ++k) {
    const sg::SE2& pose = graph.poses[k];
    const double slope =
        15 * 2 * std::acos(-1.0) / 60 * std::cos(2 * std::acos(-1.0) / 60 * pose.x);
    CHECK(std::tan(pose.theta) == Approx(slope).margin(1e-7));
    if (k > 0) {  // the chord is shorter than the path by the curvature alone
      const double chord = std::hypot(pose.x - graph.poses[k - 1].x, pose.y - graph.poses[k - 1].y);
      CHECK(chord == Approx(0.25).epsilon(1e-4));
    }
    for (const Vector3d& l : graph.landmarks) {
      const double dx = l.x() - pose.x, dy = l.y() - pose.y, d = std::hypot(dx, dy);
      const double off =
          std::abs(std::remainder(std::atan2(dy, dx) - pose.theta, 2 * std::acos(-1.0)));
      const double distance = std::hypot(d, l.z());
      const bool in_view =
          distance <= 25 && distance >= 1 && off <= std::acos(-1.0) / 4 && std::abs(l.z()) <= d;
      observations += in_view;
    }
  }
  CHECK(observations == graph.seen.items.size());
}

TEST_CASE("landmarks that stay are triangulated", "[world]") {
  sg::world::LandmarkGraph graph;
  graph.sensor = sg::world::Sensor::bearing;
  graph.poses = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  graph.landmarks = {{1000, 1, 0}, {2, 2, 0}, {5, 0, 0}, {3, 1, 0}};
  // Landmark 3 once, 2 along a line, 0 too far away.
  graph.seen = {{0, 3, 6, 9}, {3, 0, 1, 0, 1, 2, 0, 1, 2}};
  sg::world::keep_triangulated(graph, {.observations = 2, .parallax = 1});
  REQUIRE(graph.landmarks.size() == 1);
  CHECK(graph.landmarks[0] == Vector3d(2, 2, 0));
  CHECK(graph.seen.items == std::vector<Index>{0, 0, 0});
  CHECK(graph.seen.begin == std::vector<Index>{0, 1, 2, 3});
}

TEST_CASE("a planar sensor takes no notice of a landmark's height", "[world]") {
  for (const double parallax : {0.0, 40.0}) {
    sg::world::LandmarkGraph graph;
    graph.sensor = sg::world::Sensor::bearing;
    graph.poses = {{0, 0, 0}, {2, 0, 0}};
    graph.landmarks = {{1, 1, 1000}};  // seen from above, at a right angle
    graph.seen = {{0, 1, 2}, {0, 0}};
    sg::world::keep_triangulated(graph, {.observations = 2, .parallax = parallax});
    CHECK(graph.landmarks.size() == 1);
  }
}

TEST_CASE("without a wanted parallax one direction will do", "[world]") {
  sg::world::LandmarkGraph graph;
  graph.sensor = sg::world::Sensor::bearing;
  graph.poses = {{0, 0, 0}, {1, 0, 0}};
  graph.landmarks = {{5, 0, 0}};
  graph.seen = {{0, 1, 2}, {0, 0}};
  sg::world::keep_triangulated(graph, {.observations = 2, .parallax = 0});
  CHECK(graph.landmarks.size() == 1);
}

TEST_CASE("worst joins every landmark to every pose", "[world]") {
  for (const sg::world::Sensor sensor : sensors) {
    sg::world::Worst world;
    world.poses = 7;
    world.landmarks = 11;
    world.sensor = sensor;
    const Graph graph = read(text_of_world(sg::world::worst(world), Copy::noisy));
    check_spine(graph, 7);
    REQUIRE(graph.vertices() == 18);
    REQUIRE(graph.edges() == 6 + 7 * 11);
    std::set<std::pair<Index, Index>> seen;
    for (Index e = 0; e < graph.edges(); ++e) {
      const auto ends = graph.edge(e);
      const auto [pose, landmark] = std::minmax(ends[0], ends[1]);
      if (landmark >= 7) seen.insert({pose, landmark});
    }
    CHECK(seen.size() == 77);
  }
}

TEST_CASE("loop closures join what is near", "[world]") {
  const auto nearest = [](const auto& graph, double reach) {
    for (const sg::world::Loop& loop : graph.loops) {
      REQUIRE(loop.from < loop.to - 1);
      const auto z = between(graph.truth(loop.from), graph.truth(loop.to));
      if constexpr (std::is_same_v<std::decay_t<decltype(z)>, sg::SE2>) {
        REQUIRE(std::max(std::abs(z.x), std::abs(z.y)) <= reach);
      } else {
        REQUIRE(z.t.norm() <= reach);
      }
    }
    REQUIRE(std::is_sorted(graph.loops.begin(), graph.loops.end(),
                           [](const auto& a, const auto& b) { return a.to < b.to; }));
    REQUIRE(graph.loops.size() > static_cast<std::size_t>(graph.poses) / 4);
  };
  nearest(sg::world::manhattan({.poses = 2000}), 1 + 1e-9);
  nearest(sg::world::manhattan({.poses = 2000, .streets = {.block = 3, .side = 20}, .reach = 2}),
          2 + 1e-9);
  nearest(sg::world::sphere({.poses = 2500}), 1.01);
  nearest(sg::world::torus({.poses = 5000}), 2);
  nearest(sg::world::grid3d({.poses = 1000}), 1 + 1e-9);
  nearest(sg::world::grid3d({.poses = 1000, .walk = sg::world::GridWalk::random}), 1 + 1e-9);
}

TEST_CASE("worlds have the sizes of the graphs they are named after", "[world]") {
  const auto edges = [](const auto& graph) {
    return graph.poses - 1 + static_cast<Index>(graph.loops.size());
  };
  CHECK(edges(sg::world::sphere({.poses = 2500})) == 4949);                           // sphere2500
  CHECK(edges(sg::world::torus({.poses = 5000})) == Approx(9048).epsilon(0.05));      // torus3D
  CHECK(edges(sg::world::grid3d({.poses = 8000})) == Approx(22236).epsilon(0.05));    // grid3D
  CHECK(edges(sg::world::manhattan({.poses = 3500})) == Approx(5453).epsilon(0.05));  // M3500
}

TEST_CASE("a grid's sweep closes every pair of neighbours when it misses none", "[world]") {
  for (const Index side : {2, 3, 4}) {
    const auto graph =
        sg::world::grid3d({.poses = side * side * side, .side = side, .loop_chance = 1});
    const std::size_t pairs = 3 * side * side * (side - 1);
    CHECK(graph.loops.size() == pairs - (graph.poses - 1));
  }
}

TEST_CASE("poses stay inside the city, on its streets, a metre apart", "[world]") {
  sg::world::Random random = sg::world::random_stream(3, sg::world::Stream::structure);
  const auto walk = sg::world::street_walk({.block = 4, .side = 10}, 5000, random);
  for (std::size_t k = 0; k < walk.size(); ++k) {
    REQUIRE(std::min(walk[k].x, walk[k].y) >= 0);
    REQUIRE(std::max(walk[k].x, walk[k].y) <= 12);  // whole blocks
    REQUIRE((walk[k].x % 4 == 0 || walk[k].y % 4 == 0));
    if (k > 0)
      REQUIRE(std::abs(walk[k].x - walk[k - 1].x) + std::abs(walk[k].y - walk[k - 1].y) == 1);
  }
}

TEST_CASE("city finds all landmarks in view", "[world]") {
  const sg::world::City world{
      .poses = 300, .landmarks = 400, .optics = {.range = 7, .near = 0.1, .view = 120}};
  const sg::world::LandmarkGraph graph = sg::world::city(world);
  std::size_t seen = 0;
  for (const sg::SE2& pose : graph.poses) {
    for (const Vector3d& l : graph.landmarks) {
      const double dx = l.x() - pose.x, dy = l.y() - pose.y, d = std::hypot(dx, dy);
      const double off =
          std::abs(std::remainder(std::atan2(dy, dx) - pose.theta, 2 * std::acos(-1.0)));
      seen += d <= 7 && d >= 0.1 && off <= std::acos(-1.0) / 3;
    }
  }
  CHECK(seen == graph.seen.items.size());
}

TEST_CASE("a seed gives the same world again, another seed another", "[world]") {
  const auto text = [](std::uint64_t seed) {
    sg::world::Sine world;
    world.poses = 30;
    world.seed = seed;
    return text_of_world(sg::world::sine(world), Copy::noisy);
  };
  CHECK(text(1) == text(1));
  CHECK(text(1) != text(2));
  CHECK(text(1) != text(1 + (std::uint64_t{1} << 32)));
}

TEST_CASE("another noise moves no landmark and no pose of the truth", "[world]") {
  sg::world::Sine world;
  world.poses = 30;
  const std::string before = text_of_world(sg::world::sine(world), Copy::exact);
  world.guess = sg::world::Guess::truth;
  world.guess_noise = 0.5;
  CHECK(text_of_world(sg::world::sine(world), Copy::exact) == before);
}

TEST_CASE("odometry adds up to the estimates", "[world]") {
  const Graph graph = read(text_of_world(sg::world::manhattan({.poses = 500}), Copy::noisy));
  std::vector<double> a, b, z;
  for (Index e = 0; e < graph.edges(); ++e) {
    const auto ends = graph.edge(e);
    if (ends[1] != ends[0] + 1) continue;
    graph::vertex_numbers(graph, ends[0], a);
    graph::vertex_numbers(graph, ends[1], b);
    graph::edge_numbers(graph, e, z);
    CHECK((error_of("EDGE_SE2", a, b, z, {})).norm() < 1e-8);
  }
}

TEST_CASE("numbers are rounded to nine digits after the point", "[world]") {
  const auto written = [](double x) {
    std::string text;
    sg::world::Out out{[&](std::string_view piece) { text += piece; }};
    world::number(out, x);
    world::flush(out);
    return text;
  };
  CHECK(written(0) == " 0");
  CHECK(written(-0.0) == " 0");
  CHECK(written(-4e-10) == " 0");
  CHECK(written(6e-10) == " 0.000000001");
  CHECK(written(-1.5) == " -1.5");
  CHECK(written(100) == " 100");
  CHECK(written(1234.0000000004) == " 1234");
  CHECK(written(-0.123456789499) == " -0.123456789");
  CHECK(written(8999999.125) == " 8999999.125");
  CHECK(written(8999999.999) == " 8999999.999");
  CHECK(written(9e6) == " 9e+06");
  CHECK(written(1e20) == " 1e+20");
  sg::world::Random random = sg::world::random_stream(1, sg::world::Stream::structure);
  for (int i = 0; i < 10000; ++i) {
    const double x = sg::world::normal(random, std::pow(10, sg::world::uniform(random, -9, 6)));
    CHECK(std::stod(written(x)) == sg::world::rounded(x));
    CHECK(std::abs(sg::world::rounded(x) - x) <= 0.5e-9 + 1e-15 * std::abs(x));
  }
}

namespace {

// False edges: lines of the noisy graph that are comments of the exact one.
template <class World>
std::string false_lines(const World& world) {
  std::istringstream exact(text_of_world(world, Copy::exact)),
      noisy(text_of_world(world, Copy::noisy));
  std::string result, of_exact, of_noisy;
  while (std::getline(exact, of_exact)) {
    REQUIRE(std::getline(noisy, of_noisy));
    if (!of_exact.starts_with("# false ")) continue;
    CHECK(of_exact.substr(8) == of_noisy);
    result += of_noisy + "\n";
  }
  CHECK_FALSE(std::getline(noisy, of_noisy));
  return result;
}

// That a share of the edges beside odometry is false, and that they are: in the exact graph they have errors.
template <class World>
void check_outliers(const World& world, double share) {
  const std::string exact = text_of_world(world, Copy::exact), lines = false_lines(world);
  const Graph truth = read(exact), all = read(exact + lines);
  const factor::Problem problem = factor::make_problem(all);
  const factor::Values values = factor::start_values(problem);
  const auto roles = graph::edge_roles(all, graph::pose_index(all));
  Index wrong = all.edges() - truth.edges();
  for (Index e = 0; e < all.edges(); ++e) {
    const double chi2 = factor::edge_chi2(problem, values, e);
    if (e < truth.edges()) {
      CHECK(chi2 < 1e-3);
    } else {
      CHECK(chi2 > 25);  // ten deviations, and noise on top
      CHECK(roles[e] != graph::EdgeRole::odometry);
    }
  }
  const auto odometry = std::ranges::count(roles, graph::EdgeRole::odometry);
  CHECK(static_cast<double>(wrong) ==
        Approx(share * static_cast<double>(all.edges() - odometry)).margin(1));
}

}  // namespace

TEST_CASE("so many edges are false as are asked for, and the exact graph tells which", "[world]") {
  for (const double share : {0.1, 0.4}) {
    for (const std::uint64_t seed : {1, 2}) {
      using namespace sg::world;
      check_outliers(manhattan({.poses = 300, .outliers = share, .seed = seed}), share);
      check_outliers(sphere({.poses = 100, .outliers = share, .seed = seed}), share);
      check_outliers(torus({.poses = 100, .outliers = share, .seed = seed}), share);
      check_outliers(grid3d({.poses = 60, .outliers = share, .seed = seed}), share);
      check_outliers(city({.poses = 60, .outliers = share, .seed = seed}), share);
      check_outliers(
          worst({.poses = 5, .landmarks = 9, .optics = {}, .outliers = share, .seed = seed}),
          share);
      for (const Sensor sensor : sensors)
        check_outliers(sine({.poses = 40,
                             .landmark = {},
                             .sensor = sensor,
                             .optics = {},
                             .outliers = share,
                             .seed = seed}),
                       share);
    }
  }
}

TEST_CASE("outliers change nothing else of a world", "[world]") {
  const auto without = [](const std::string& lines, std::string text) {
    std::istringstream stream(lines);
    for (std::string line; std::getline(stream, line);) {
      line += "\n";
      text.erase(text.find(line), line.size());
    }
    return text;
  };
  const auto world = sg::world::manhattan({.poses = 300, .outliers = 0.3});
  CHECK(without(false_lines(world), text_of_world(world, Copy::noisy)) ==
        text_of_world(sg::world::manhattan({.poses = 300}), Copy::noisy));
  const auto city = sg::world::city({.poses = 60, .outliers = 0.3});
  CHECK(without(false_lines(city), text_of_world(city, Copy::noisy)) ==
        text_of_world(sg::world::city({.poses = 60}), Copy::noisy));
}

TEST_CASE("a world too small for outliers is refused", "[world]") {
  CHECK_THROWS_AS(sg::world::worst({.poses = 4, .landmarks = 1, .optics = {}, .outliers = 0.2}),
                  text::Error);
  CHECK_NOTHROW(sg::world::worst({.poses = 4, .landmarks = 1, .optics = {}}));
  CHECK(sg::world::manhattan({.poses = 3, .outliers = 0.5}).false_loops.empty());
}
