#include <Eigen/Core>
#include <catch2/catch.hpp>
#include <iomanip>
#include <sstream>

#include "formats/formats.h"
#include "lib/factor/initialize.h"
#include "lib/factor/linear.h"
#include "lib/factor/linearize.h"
#include "lib/factor/residuals.h"
#include "lib/text/error.h"
#include "tests/unit/common.h"

using namespace sg;
using namespace sg::test;

namespace {

// A random estimate; a pose far enough from landmarks at `ahead` that they are in front of its
// camera.
std::vector<double> random_estimate(Random& random, graph::Space space) {
  std::vector<double> x(graph::space_size(space));
  factor::set_origin(space, x.data());
  std::vector<double> step(graph::space_dim(space));
  for (double& number : step) number = uniform(random, -0.6, 0.6);
  factor::retract(space, step.data(), x.data());
  if (space == graph::Space::xyz) x[2] += 5;
  return x;
}

struct Instance {
  const factor::Model& model;
  int dim;
  std::vector<graph::Space> spaces;
  std::vector<std::vector<double>> x;
  std::vector<double> constants;
  std::vector<double> U;
  bool diagonal = false;

  std::vector<const double*> ends() const {
    std::vector<const double*> pointers;
    for (const auto& end : x) pointers.push_back(end.data());
    return pointers;
  }
};

void set_whitening(Random& random, Instance& instance) {
  const int dim = instance.dim;
  Eigen::MatrixXd U =
      Eigen::MatrixXd::NullaryExpr(dim, dim, [&] { return uniform(random, -1, 1); });
  instance.diagonal = draw(random, 0, 1) == 1;
  if (instance.diagonal) U = Eigen::MatrixXd(U.diagonal().asDiagonal());
  instance.U.assign(U.data(), U.data() + U.size());
}

// A linear factor of one to four vertices of the plane, of space, or of cameras and points; a pose first.
Instance random_linear(Random& random, const factor::Model& model) {
  using enum graph::Space;
  const std::vector<std::vector<graph::Space>> worlds{
      {se2, xy}, {se3, xyz}, {expmap, bal_camera, xyz}};
  const auto& world = worlds[draw(random, 0, 2)];
  const int poses = static_cast<int>(world.size()) - 1;
  Instance instance{model, 0, {world[draw(random, 0, poses - 1)]}, {}, {}, {}};
  for (int k = draw(random, 1, 3); k > 0; --k)
    instance.spaces.push_back(world[draw(random, 0, poses)]);
  std::vector<double> numbers;
  for (const graph::Space space : instance.spaces) {
    instance.x.push_back(random_estimate(random, space));
    const std::vector<double> at = random_estimate(random, space);
    numbers.insert(numbers.end(), at.begin(), at.end());
  }
  const graph::LinearSize size = graph::linear_size(model.type, instance.spaces);
  instance.dim = size.dim;
  for (int k = 0; k < size.dim; ++k) numbers.push_back(uniform(random, -0.1, 0.1));
  REQUIRE(factor::misfit(model.type, instance.spaces).empty());
  REQUIRE(static_cast<int>(numbers.size()) == size.measurement);
  instance.constants.resize(factor::linear_constants(size, instance.spaces));
  REQUIRE(factor::prepare_linear(model.type, instance.spaces, numbers.data(),
                                 instance.constants.data()));
  CHECK(factor::linear_dim(instance.constants.data()) == size.dim);
  set_whitening(random, instance);
  return instance;
}

// A random measurement, camera and offset near to what random estimates would see.
Instance random_instance(Random& random, const factor::Model& model) {
  if (graph::is_linear(model.type)) return random_linear(random, model);
  Instance instance{model, model.dim, {}, {}, std::vector<double>(model.constants), {}};
  for (int k = 0; k < model.arity; ++k) {
    instance.spaces.push_back(model.ends[k]);
    instance.x.push_back(random_estimate(random, model.ends[k]));
  }
  std::vector<double> z(model.measurement + model.extra);
  for (double& number : z) number = uniform(random, 0.5, 1.5);
  if (model.measurement == 7) Eigen::Map<Eigen::Vector4d>(z.data() + 3).normalize();
  std::vector<std::vector<double>> params;
  std::vector<const double*> pointers;
  for (graph::ParamTag type : model.params) {
    std::vector<double> param(graph::row(type).numbers);
    for (double& number : param) number = uniform(random, 0.1, 0.9);
    if (param.size() >= 7) {  // turned so little that landmarks stay ahead
      Eigen::Map<Eigen::Vector3d>(param.data() + 3) *= 0.2;
      Eigen::Map<Eigen::Vector4d>(param.data() + 3).normalize();
    }
    params.push_back(param);
  }
  for (const auto& param : params) pointers.push_back(param.data());
  REQUIRE(model.prepare(z.data(), pointers.data(), instance.constants.data()));
  set_whitening(random, instance);
  return instance;
}

Eigen::VectorXd error(const Instance& instance) {
  Eigen::VectorXd r(instance.dim);
  instance.model.error(instance.ends().data(), instance.constants.data(),
                       {instance.U.data(), instance.diagonal}, r.data());
  return r;
}

Eigen::VectorXd error_after(Instance instance, int end, int axis, double length) {
  std::vector<double> step(graph::space_dim(instance.spaces[end]), 0.0);
  step[axis] = length;
  factor::retract(instance.spaces[end], step.data(), instance.x[end].data());
  return error(instance);
}

void check_jacobian(const Instance& instance) {
  const factor::Model& model = instance.model;
  int width = 1;
  for (const graph::Space space : instance.spaces) width += graph::space_dim(space);
  std::vector<double> block(instance.dim * width);
  model.linearize(instance.ends().data(), instance.constants.data(),
                  {instance.U.data(), instance.diagonal}, block.data());
  Eigen::Map<Eigen::MatrixXd> columns(block.data(), instance.dim, width);
  int column = 0;
  for (int end = 0; end < static_cast<int>(instance.spaces.size()); ++end) {
    for (int axis = 0; axis < graph::space_dim(instance.spaces[end]); ++axis, ++column) {
      const auto slope = [&](double h) -> Eigen::VectorXd {
        return (error_after(instance, end, axis, h) - error_after(instance, end, axis, -h)) /
               (2 * h);
      };
      // Close to a camera's plane errors bend so much that the difference of two steps says how far to trust either.
      const Eigen::VectorXd expected = slope(1e-6);
      const double doubt = (slope(2e-6) - expected).norm();
      INFO(model.tag << " end " << end << " axis " << axis);
      CHECK((columns.col(column) - expected).norm() < 1e-7 * (1 + expected.norm()) + doubt);
    }
  }
  CHECK((columns.col(column) + error(instance)).norm() < 1e-12 * (1 + error(instance).norm()));
}

}  // namespace

TEST_CASE("every model's Jacobian is its numerical one", "[factor]") {
  Random random(1);
  for (const factor::Model& model : factor::models()) {
    for (int trial = 0; trial < 20; ++trial) check_jacobian(random_instance(random, model));
  }
}

namespace {

std::string message_of(const std::string& text) {
  const Graph graph = graph_of(text);
  try {
    const factor::Problem problem = factor::make_problem(graph);
    factor::start_values(problem);
  } catch (const text::Error& error) {
    return text::message(error);
  }
  return "";
}

// The system as one dense matrix [A b], columns by variable.
Eigen::MatrixXd dense(const factor::Problem& problem, const factor::LinearSystem& system) {
  const graph::Pattern& pattern = *system.pattern;
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(0, problem.step_at.back() + 1);
  for (Index r = 0; r < pattern.rows.size(); ++r) {
    const auto top = all.rows();
    const int height = system.height[r];
    all.conservativeResize(top + height, Eigen::NoChange);
    all.bottomRows(height).setZero();
    const double* block = system.block(r);
    for (Index j : pattern.rows[r]) {
      all.block(top, problem.step_at[j], height, pattern.dim[j]) =
          Eigen::Map<const Eigen::MatrixXd>(block, height, pattern.dim[j]);
      block += height * pattern.dim[j];
    }
    all.bottomRows(height).rightCols(1) = Eigen::Map<const Eigen::MatrixXd>(block, height, 1);
  }
  return all;
}

// The same by moving every scalar of the estimate a little. Rows of the edges alone.
Eigen::MatrixXd numerical(const factor::Problem& problem, const factor::Values& values) {
  const auto errors = [&](const factor::Values& x) {
    std::vector<double> all;
    for (Index e = 0; e < problem.graph->edges(); ++e) {
      std::vector<double> r(factor::dim_of(problem, e));
      const factor::Model& model = *problem.model[e];
      model.error(factor::ends_of(problem, x, e).data(), factor::constants_of(problem, e),
                  factor::whitening_of(problem, e), r.data());
      all.insert(all.end(), r.begin(), r.end());
    }
    return Eigen::VectorXd(Eigen::Map<Eigen::VectorXd>(all.data(), static_cast<Index>(all.size())));
  };
  const int scalars = problem.step_at.back();
  const Eigen::VectorXd at = errors(values);
  Eigen::MatrixXd all(at.size(), scalars + 1);
  for (int k = 0; k < scalars; ++k) {
    const auto moved = [&](double h) {
      std::vector<double> step(scalars, 0.0);
      step[k] = h;
      factor::Values x = values;
      factor::retract(problem, step, x);
      return errors(x);
    };
    all.col(k) = (moved(1e-6) - moved(-1e-6)) / 2e-6;
  }
  all.rightCols(1) = -at;
  if (problem.held >= 0)
    all.middleCols(problem.step_at[problem.held], factor::held_dim(problem)).setZero();
  return all;
}

void check_system(const Graph& graph) {
  const factor::Problem problem = factor::make_problem(graph);
  const factor::Values values = factor::start_values(problem);
  factor::LinearSystem system = factor::make_linear_system(problem);
  factor::linearize(problem, values, {}, system);
  const Eigen::MatrixXd expected = numerical(problem, values);
  const Eigen::MatrixXd given = dense(problem, system).topRows(expected.rows());
  for (Index r = 0; r < expected.rows(); ++r) {
    INFO("row " << r);
    CHECK((given.row(r) - expected.row(r)).norm() < 1e-6 * (1 + expected.row(r).norm()));
  }
  CHECK(factor::chi2(problem, values) == Approx(given.rightCols(1).squaredNorm()).epsilon(1e-12));
}

}  // namespace

// What g2o prints for these files.
TEST_CASE("chi-square is g2o's", "[factor]") {
  const auto chi2_of = [](const std::string& name) {
    const Graph graph = test_graph(name);
    const factor::Problem problem = factor::make_problem(graph);
    return factor::chi2(problem, factor::start_values(problem));
  };
  CHECK(chi2_of("types-se2.g2o") == Approx(128.371198).margin(6e-7));
  CHECK(chi2_of("types-se3.g2o") == Approx(600.010429).margin(6e-7));
  CHECK(chi2_of("types-expmap.g2o") == Approx(5021.171853).margin(6e-7));
  CHECK(chi2_of("desk.bal") ==
        Approx(30642.170234).margin(6e-7));  // g2o has no reader: by another program
}

TEST_CASE("the files of every type hold every type", "[factor]") {
  std::string text;
  for (const char* name : {"types-se2.g2o", "types-se3.g2o", "types-expmap.g2o", "desk.bal"}) {
    text += std::string(test_graph(name).text.view);
  }
  for (const factor::Model& model : factor::models()) {
    if (graph::is_linear(model.type)) continue;  // of no program but ours
    INFO(model.tag);
    CHECK(text.find("\n" + std::string(model.tag) + " ") != text.npos);
  }
}

TEST_CASE("the linearized system is the numerical one", "[factor]") {
  for (const char* name : {"types-se2.g2o", "types-se3.g2o", "types-expmap.g2o", "desk.bal"}) {
    check_system(test_graph(name));
  }
}

TEST_CASE("fixed vertices, loops and repeated edges linearize like the rest", "[factor]") {
  const std::string vertices =
      "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0.2 0.1\nVERTEX_SE2 2 2 0 -3\nVERTEX_XY 3 1 1\n";
  const std::string edges =
      "EDGE_SE2 0 1 1 0 0 2 0.1 0 1 0 3\nEDGE_SE2 1 0 1 0 0 2 0.1 0 1 0 3\n"
      "EDGE_SE2 1 2 1 0.1 3 1 0 0 1 0 1\nEDGE_SE2 1 1 0.1 0.2 0.3 1 0 0 1 0 1\n"
      "EDGE_SE2_XY 2 3 1 1 1 0 1\nEDGE_SE2_XY 0 3 1 1 1 0 1\n";
  check_system(graph_of(vertices + edges));
  check_system(graph_of(vertices + "FIX 0\n" + edges));
  check_system(graph_of(vertices + "FIX 1\n" + edges));
  check_system(graph_of(vertices + "FIX 0 3\n" + edges));
}

namespace {

// A linear factor's line from these vertices of a graph, with its estimates, moved a little, as linearization point.
std::string linear_line(Random& random, const Graph& graph, const std::string& tag,
                        const std::vector<Index>& vertices) {
  std::ostringstream line;
  line << std::setprecision(17) << tag << " " << graph.id[vertices[0]] << " "
       << vertices.size() - 1;
  std::vector<graph::Space> spaces;
  std::vector<double> numbers;
  for (const Index v : vertices) {
    if (v != vertices[0]) line << " " << graph.id[v];
    spaces.push_back(graph.type_of_vertex(v).space);
  }
  for (const Index v : vertices) {
    graph::vertex_numbers(graph, v, numbers);
    for (int k = 0; k < 3 && k < std::ssize(numbers); ++k) numbers[k] += uniform(random, -0.1, 0.1);
    for (const double number : numbers) line << " " << number;
  }
  const auto type = static_cast<graph::EdgeTag>(graph.tags.find(tag)->type);
  const int dim = graph::linear_size(type, spaces).dim;
  for (int k = 0; k < dim; ++k) line << " " << uniform(random, -0.1, 0.1);
  const Eigen::MatrixXd root =
      Eigen::MatrixXd::NullaryExpr(dim, dim, [&] { return uniform(random, -1, 1); });
  const Eigen::MatrixXd W = root.transpose() * root;
  for (int i = 0; i < dim; ++i) {
    for (int j = i; j < dim; ++j) line << " " << W(i, j);
  }
  return line.str() + "\n";
}

}  // namespace

TEST_CASE("linear factors of many vertices linearize like the rest, constants among them",
          "[factor]") {
  for (int seed = 0; seed < 12; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const bool plane = seed % 2 == 0;
    std::string text;
    std::vector<Index> vertices;
    for (Index v = 0; v < 6; ++v) {
      const bool landmark = v > 3;
      text += plane      ? landmark ? "VERTEX_XY " : "VERTEX_SE2 "
              : landmark ? "VERTEX_TRACKXYZ "
                         : "VERTEX_SE3:QUAT ";
      text += std::to_string(v);
      for (int k = 0; k < (plane ? 2 : 3) + (plane && !landmark ? 1 : 0); ++k)
        text += " " + std::to_string(uniform(random, -1, 1));
      text += plane || landmark ? "\n" : " 0.1 0.2 0.3 0.9273618495495703\n";
      vertices.push_back(v);
    }
    const Graph bare = graph_of(text);
    for (const std::string tag : {"EDGE_LINEAR", "EDGE_LINEAR_RELATIVE"}) {
      shuffle(random, vertices);
      std::vector<Index> some(vertices.begin(), vertices.begin() + draw(random, 2, 6));
      std::ranges::sort(some);
      if (tag == "EDGE_LINEAR_RELATIVE" && some[0] > 3) some = {0, 5};
      text += linear_line(random, bare, tag, some);
    }
    if (seed % 3 == 0) text += "FIX 0\n";
    check_system(graph_of(text));
  }
}

TEST_CASE("a relative linear factor does not notice a motion of the whole, an absolute one does",
          "[factor]") {
  const std::string vertices = "VERTEX_SE2 0 1 2 0.3\nVERTEX_SE2 1 2 2.5 0.7\nVERTEX_XY 5 -1 0\n";
  Random random(1);
  const Graph bare = graph_of(vertices);
  const auto held = [](const std::string& text) {
    const Graph graph = graph_of(text);
    return factor::make_problem(graph).held;
  };
  const std::string relative = linear_line(random, bare, "EDGE_LINEAR_RELATIVE", {0, 1, 2});
  CHECK(held(vertices + relative) == 0);
  CHECK(held(vertices + linear_line(random, bare, "EDGE_LINEAR", {0, 1, 2})) == -1);
  const auto chi2_of = [](const std::string& text) {
    const Graph graph = graph_of(text);
    const factor::Problem problem = factor::make_problem(graph);
    return factor::chi2(problem, factor::file_values(problem));
  };
  // Turned by a quarter about the origin.
  const std::string turned =
      "VERTEX_SE2 0 -2 1 1.8707963267948966\nVERTEX_SE2 1 -2.5 2 2.2707963267948966\nVERTEX_XY 5 0 "
      "-1\n";
  CHECK(chi2_of(turned + relative) == Approx(chi2_of(vertices + relative)).epsilon(1e-12));
  CHECK(chi2_of(vertices + relative) > 1e-3);
}

TEST_CASE("linear factors that say too little or of the wrong vertices are refused", "[factor]") {
  const std::string vertices = "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nVERTEX_XY 5 1 1\n";
  CHECK(message_of(vertices + "EDGE_LINEAR 0 1 5 0 0 0 1 1 0 0 0 0 0 1\n") ==
        "test.g2o:4: EDGE_LINEAR wants 25 numbers, not 11");
  CHECK(message_of(vertices + "EDGE_LINEAR_RELATIVE 5 1 0 1 1 0 0 0 0 0 0 1 0 0 1 0 1\n") ==
        "test.g2o:4: EDGE_LINEAR_RELATIVE wants a pose first, and then vertices that are seen from "
        "it, of its plane "
        "or space");
  CHECK(message_of(vertices + "EDGE_LINEAR 5 0 1 1 0 0 1 3 1\n") ==
        "test.g2o:4: the information matrix is not positive semidefinite");
  CHECK(message_of(vertices + "EDGE_LINEAR 5 0 1 1 0 0 1 0 1\n").empty());
}

TEST_CASE("the first pose is held unless something else holds the graph", "[factor]") {
  const std::string two =
      "VERTEX_XY 1 0 0\nVERTEX_SE2 2 0 0 0\nVERTEX_SE2 3 1 0 0\n"
      "EDGE_SE2 2 3 1 0 0 1 0 0 1 0 1\nEDGE_SE2_XY 2 1 0 0 1 0 1\n";
  const auto held = [](const std::string& text) {
    const Graph graph = graph_of(text);
    return factor::make_problem(graph).held;
  };
  CHECK(held(two) == 1);
  CHECK(held(two + "FIX 3\n") == -1);
  CHECK(held(two + "EDGE_PRIOR_SE2 3 1 0 0 1 0 0 1 0 1\n") == -1);
  CHECK(held(two + "EDGE_PRIOR_SE2_XY 3 1 0 1 0 1\n") == 1);
  // A constant landmark lets the whole turn about it; a second one does not.
  CHECK(held(two + "FIX 1\n") == 0);
  CHECK(held(two +
             "VERTEX_XY 4 1 1\nEDGE_SE2_XY 3 4 0 1 1 0 1\nEDGE_SE2_XY 2 4 1 1 1 0 1\nFIX 1 4\n") ==
        -1);
  // A prior without information holds nothing, and one that knows the place alone lets it turn.
  CHECK(held(two + "EDGE_PRIOR_SE2 3 1 0 0 0 0 0 0 0 0\n") == 1);
  CHECK(held(two + "EDGE_PRIOR_SE2 3 1 0 0 1 0 0 1 0 0\n") == 1);
}

TEST_CASE("rank decides whether priors hold the graph", "[factor]") {
  const auto held = [](const std::string& text) {
    const Graph graph = graph_of(text);
    return factor::make_problem(graph).held;
  };
  for (const char* const at : {"0 0", "412345.1 5432100.2"}) {
    std::istringstream place(at);
    double x = 0, y = 0;
    place >> x >> y;
    const auto number = [](double value) {
      std::ostringstream text;
      text << std::setprecision(17) << value;
      return text.str();
    };
    std::string plane, space;
    for (int k = 0; k < 4; ++k) {
      const std::string id = std::to_string(k);
      plane += "VERTEX_SE2 " + id + " " + number(x + k) + " " + number(y) + " 0.1\n";
      space += "VERTEX_SE3:QUAT " + id + " " + number(x + k) + " " + number(y + (k == 3)) +
               " 7 0 0 0.6 0.8\n";
    }
    for (int k = 1; k < 4; ++k) {
      const std::string ends = std::to_string(k - 1) + " " + std::to_string(k);
      plane += "EDGE_SE2 " + ends + " 1 0 0 1 0 0 1 0 1\n";
      space +=
          "EDGE_SE3:QUAT " + ends + " 1 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n";
    }
    const auto prior = [&](int k) {
      return "EDGE_PRIOR_SE2_XY " + std::to_string(k) + " 0 0 1 0 1\n";
    };
    CHECK(held(plane + prior(1)) == 0);
    CHECK(held(plane + prior(1) + prior(1)) == 0);
    CHECK(held(plane + prior(1) + prior(3)) == -1);
    // What holds x only, twice, lets y go.
    CHECK(held(plane + "EDGE_PRIOR_SE2_XY 1 0 0 1 0 0\nEDGE_PRIOR_SE2_XY 3 0 0 1 0 0\n") == 0);
    const auto place_in_space = [&](int k) {
      return "EDGE_SE3_XYZ_PRIOR " + std::to_string(k) + " 9 0 0 0 1 0 0 1 0 1\n";
    };
    const std::string offset = "PARAMS_SE3OFFSET 9 0 0 0 0 0 0 1\n";
    const std::string three = offset + space + place_in_space(0) + place_in_space(1);
    CHECK(held(three) == 0);
    CHECK(held(three + place_in_space(2)) == 0);  // all on a line
    CHECK(held(three + place_in_space(3)) == -1);
    // Estimates that all stand at one place tell nothing; composed ones do.
    std::string nowhere;
    for (int k = 0; k < 4; ++k) nowhere += "VERTEX_SE2 " + std::to_string(k) + " 0 0 0\n";
    CHECK(held(nowhere + plane.substr(plane.find("EDGE")) + prior(0) + prior(3)) == -1);
  }
}

TEST_CASE("composed estimates stand where the gauge is held", "[factor]") {
  const auto chi2_of = [](const std::string& text) {
    const Graph graph = graph_of(text);
    const factor::Problem problem = factor::make_problem(graph);
    const factor::Values composed = factor::initial_values(problem);
    if (problem.held >= 0 && !graph.edges_only) {
      const Index v = problem.variables.variable_vertex[problem.held];
      const factor::Values given = factor::file_values(problem);
      for (Index k = problem.value_at[v]; k < problem.value_at[v + 1]; ++k)
        CHECK(composed[k] == given[k]);
    }
    return factor::chi2(problem, composed);
  };
  const std::string off =
      "VERTEX_SE2 0 5 3 1\nVERTEX_SE2 1 6 3 1.2\nVERTEX_SE2 2 7 3 1.1\nVERTEX_XY 3 0 0\n"
      "EDGE_SE2 0 1 1 0 0 100 0 0 100 0 400\nEDGE_SE2 1 2 1 0 0 100 0 0 100 0 400\n"
      "EDGE_SE2_XY 2 3 1 1 1 0 1\n";
  CHECK(chi2_of(off) < 1e-20);
  // A prior at the end: composed from there, in both directions.
  CHECK(chi2_of(off + "EDGE_PRIOR_SE2 2 -4 2 0.5 1 0 0 1 0 1\n") < 1e-20);
  CHECK(chi2_of(off + "FIX 1\n") < 1e-20);
}

TEST_CASE("what no edge places is told", "[factor]") {
  const auto adrift = [](const std::string& text) {
    const Graph graph = graph_of(text);
    const factor::Problem problem = factor::make_problem(graph);
    return factor::compose(problem).adrift;
  };
  const std::string seen = "EDGE_SE2_XY 0 10 1 1 1 0 1\nEDGE_SE2_XY 1 10 0 1 1 0 1\n";
  CHECK(adrift(seen) == std::vector<Index>{1});
  CHECK(adrift(seen + "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n").empty());
  CHECK(adrift(seen + "EDGE_PRIOR_SE2 1 1 0 0 1 0 0 1 0 1\n") == std::vector<Index>{0});
}

TEST_CASE("a kernel's weight is the slope of its rho", "[factor]") {
  for (const factor::KernelShape& shape : factor::kernel_shapes()) {
    INFO(shape.name);
    CHECK(factor::find_kernel_shape(shape.name) == &shape);
    for (const double width : {0.7, 1.0, 3.0}) {
      const factor::Kernel kernel{&shape, width};
      CHECK(factor::weight(kernel, 0) == Approx(1));
      for (const double s : {0.1, 0.48, 0.5, 1.001, 5.0, 8.9, 100.0, 1e6}) {
        const double h = 1e-5 * s;
        const double slope = (factor::rho(kernel, s + h) - factor::rho(kernel, s - h)) / (2 * h);
        CHECK(factor::weight(kernel, s) == Approx(slope).epsilon(1e-5).margin(1e-9));
      }
      const double bend = width * width, h = 1e-9 * bend;
      CHECK(factor::rho(kernel, bend + h) == Approx(factor::rho(kernel, bend - h)).epsilon(1e-8));
      CHECK(factor::weight(kernel, bend + h) ==
            Approx(factor::weight(kernel, bend - h)).margin(1e-8));
    }
  }
  CHECK(factor::find_kernel_shape("huge") == nullptr);
}

TEST_CASE("a loss scales the blocks of the edges that it is for, by the root of their weight",
          "[factor]") {
  const Graph graph = test_graph("types-se2.g2o");
  const factor::Problem problem = factor::make_problem(graph);
  const factor::Values values = factor::start_values(problem);
  const factor::Kernel kernel{factor::find_kernel_shape("huber"), 0.5};
  factor::LinearSystem plain = factor::make_linear_system(problem), weighed = plain;
  factor::linearize(problem, values, {}, plain);
  for (const bool some : {false, true}) {
    factor::Loss loss{kernel, {}, {}};
    for (Index e = 0; some && e < graph.edges(); ++e) {
      loss.robust.push_back(e % 3 != 0);
      loss.share.push_back(e % 5 / 4.0);
    }
    factor::linearize(problem, values, loss, weighed);
    double sum = 0;
    for (Index e = 0; e < graph.edges(); ++e) {
      const double s = factor::edge_chi2(problem, values, e);
      const bool robust = !some || e % 3 != 0;
      const double share = some ? e % 5 / 4.0 : 1;
      sum += share * (robust ? factor::rho(kernel, s) : s);
      const double scale = std::sqrt(share * (robust ? factor::weight(kernel, s) : 1));
      for (Offset k = plain.begin[e]; k < plain.begin[e + 1]; ++k)
        CHECK(weighed.numbers[k] == Approx(scale * plain.numbers[k]).margin(1e-12));
    }
    CHECK(factor::chi2(problem, values, loss) == Approx(sum));
  }
}

TEST_CASE("residuals: degrees of freedom, and quantiles as tables have them", "[factor]") {
  CHECK(factor::chi2_quantile(3.841458821, 1) == Approx(0.95));
  CHECK(factor::chi2_quantile(7.814727903, 3) == Approx(0.95));
  CHECK(factor::chi2_of_quantile(0.99, 6) == Approx(16.81189383));
  CHECK(factor::chi2_of_quantile(0.9999, 3) == Approx(21.10751347));
  for (const double x : {0.01, 1.0, 9.0}) {
    CHECK(factor::chi2_quantile(x, 2) == Approx(1 - std::exp(-x / 2)));  // in closed form
    CHECK(factor::chi2_of_quantile(1 - std::exp(-x / 2), 2) == Approx(x));
  }
  CHECK(factor::chi2_quantile(0, 0) == 0);
  CHECK(factor::chi2_quantile(1, 0) == 1);
  // The second edge says nothing of the angle; the third of a combination alone; the last nothing.
  const Graph graph = graph_of(
      "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nVERTEX_SE2 2 2 0 0\n"
      "EDGE_SE2 0 1 1 0 0 4 1 0 4 0 1\nEDGE_SE2 0 1 1.5 0 0 4 0 0 4 0 0\n"
      "EDGE_SE2 1 2 1 1 0 1 1 0 1 0 0\nEDGE_SE2 1 2 3 0 0 0 0 0 0 0 0\n");
  const factor::Problem problem = factor::make_problem(graph);
  auto residuals = factor::residuals(problem, factor::start_values(problem));
  const std::vector<double> chi2{0, 1, 1, 0};
  const std::vector<int> degrees{3, 2, 1, 0};
  for (Index e = 0; e < 4; ++e) {
    CHECK(residuals[e].chi2 == Approx(chi2[e]).margin(1e-12));
    CHECK(residuals[e].degrees == degrees[e]);
  }
  factor::worst_first(residuals);
  CHECK(residuals[0].edge == 2);  // 1 is more of one degree than of two
  CHECK(residuals[1].edge == 1);
}

TEST_CASE("a singular information matrix counts for what it says", "[factor]") {
  const Graph graph =
      graph_of("VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 2 0.5\nEDGE_SE2 0 1 0 0 0 4 2 0 1 0 0\n");
  const factor::Problem problem = factor::make_problem(graph);
  CHECK(factor::chi2(problem, factor::start_values(problem)) == Approx(4 * 1 + 2 * 2 * 2 + 1 * 4));
}

TEST_CASE("estimates without VERTEX lines are composed", "[factor]") {
  const Graph graph = graph_of(
      "EDGE_SE2 0 9 5 5 0 1 0 0 1 0 1\n"  // a loop closure comes first, odometry counts
      "EDGE_SE2 0 1 1 0 1.5707963267948966 1 0 0 1 0 1\n"
      "EDGE_SE2 9 1 -1 0 0 1 0 0 1 0 1\n"
      "EDGE_SE2_XY 1 20 2 1 1 0 1\n"
      "EDGE_BEARING_SE2_XY 0 21 0.7853981633974483 1\nEDGE_BEARING_SE2_XY 1 21 0 1\n"
      "EDGE_BEARING_SE2_XY 1 22 1.5707963267948966 1\n");
  const factor::Problem problem = factor::make_problem(graph);
  const factor::Values values = factor::start_values(problem);
  const auto estimate = [&](Id id) {
    const Index v = *graph::find_vertex(graph, id);
    std::vector<double> numbers = factor::estimate_numbers(problem, values, v);
    return Eigen::VectorXd(
        Eigen::Map<Eigen::VectorXd>(numbers.data(), static_cast<Index>(numbers.size())));
  };
  const double quarter = 1.5707963267948966;
  CHECK(estimate(0).norm() == 0);
  CHECK((estimate(1) - Eigen::Vector3d(1, 0, quarter)).norm() < 1e-12);
  CHECK((estimate(9) - Eigen::Vector3d(1, 1, quarter)).norm() < 1e-12);
  CHECK((estimate(20) - Eigen::Vector2d(0, 2)).norm() < 1e-12);
  CHECK((estimate(21) - Eigen::Vector2d(1, 1)).norm() < 1e-12);
  CHECK((estimate(22) - Eigen::Vector2d(1 - factor::lone_range, 0)).norm() < 1e-12);
}

TEST_CASE("measurements without noise place every vertex exactly", "[factor]") {
  // Pixels of random points from a moving camera; the first edges place poses, pixels triangulate.
  std::string text = "PARAMS_CAMERAPARAMETERS 0 500 320 240 0\nVERTEX_SE3:EXPMAP 0 0 0 0 0 0 0 1\n";
  text += "VERTEX_SE3:EXPMAP 1 1 0 0 0 0 0 1\nVERTEX_XYZ 2 0 0 0\nFIX 0 1\n";
  text += "EDGE_PROJECT_XYZ2UV:EXPMAP 2 0 0 445 365 1 0 1\n";  // (1, 1, 4)
  text += "EDGE_PROJECT_XYZ2UV:EXPMAP 2 1 0 320 365 1 0 1\n";
  const Graph graph = graph_of(text);
  const factor::Problem problem = factor::make_problem(graph);
  const factor::Values values = factor::initial_values(problem);
  CHECK(factor::chi2(problem, values) < 1e-16);
}

TEST_CASE("estimates go to text and back", "[factor]") {
  for (const char* name : {"types-se2.g2o", "types-se3.g2o", "types-expmap.g2o", "desk.bal"}) {
    const Graph graph = test_graph(name);
    const factor::Problem problem = factor::make_problem(graph);
    const factor::Values values = factor::file_values(problem);
    for (Index v = 0; v < graph.vertices(); ++v) {
      std::vector<double> numbers;
      graph::vertex_numbers(graph, v, numbers);
      const auto written = factor::estimate_numbers(problem, values, v);
      REQUIRE(written.size() == numbers.size());
      for (std::size_t k = 0; k < numbers.size(); ++k) {
        CHECK(written[k] == Approx(numbers[k]).margin(1e-6));
      }
    }
  }
  const Graph graph = graph_of("VERTEX_SE2 0 0.1 -1e-300 3\nEDGE_PRIOR_SE2_XY 0 0 0 1 0 1\n");
  const factor::Problem problem = factor::make_problem(graph);
  CHECK(factor::estimate_text(problem, factor::file_values(problem), 0) == "0.1 -1e-300 3");
  CHECK(factor::vertex_line(problem, factor::file_values(problem), 0) ==
        "VERTEX_SE2 0 0.1 -1e-300 3\n");
}

TEST_CASE("a file without VERTEX lines gives no estimates", "[factor]") {
  const Graph graph = graph_of("EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n");
  const factor::Problem problem = factor::make_problem(graph);
  CHECK_THROWS_AS(factor::file_values(problem), text::Error);
  CHECK(factor::start_values(problem) == factor::Values{0, 0, 0, 1, 0, 0});
}

TEST_CASE("what cannot be solved is said with its line", "[factor]") {
  const std::string two = "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nVERTEX_XY 2 0 0\n";
  CHECK(message_of(two + "EDGE_SE2_POINTXY_OFFSET 0 2 0 1 1 1 0 1\n") ==
        "test.g2o:4: EDGE_SE2_POINTXY_OFFSET has no measurement model here");
  CHECK(message_of(two + "EDGE_SE2 0 1 1 0 0 1 2 0 1 0 1\n") ==
        "test.g2o:4: the information matrix is not positive semidefinite");
  CHECK(message_of(two + "EDGE_SE2 0 1 nan 0 0 1 0 0 1 0 1\n") ==
        "test.g2o:4: a number is not finite");
  CHECK(message_of("VERTEX_SE3:QUAT 0 0 0 0 0 0 0 0\n") ==
        "test.g2o:1: a quaternion has length zero");
  CHECK(message_of("VERTEX_PLANE 0 1 0 0 1\n") ==
        "test.g2o:1: VERTEX_PLANE has no measurement model here");
  CHECK(message_of("VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nVERTEX_TRACKXYZ 1 0 0 1\n"
                   "EDGE_SE3_TRACKXYZ 0 1 7 0 0 1 1 0 0 1 0 1\n") ==
        "test.g2o:3: EDGE_SE3_TRACKXYZ wants a PARAMS_SE3OFFSET line with the id 7");
}
