#include "lib/factor/problem.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "lib/factor/gauge.h"
#include "lib/factor/initialize.h"
#include "lib/factor/linear.h"
#include "lib/factor/whitening.h"
#include "lib/geometry/numbers.h"
#include "lib/geometry/triangle.h"
#include "lib/text/error.h"
#include "lib/text/words.h"

namespace sg::factor {
namespace {

std::string quoted(std::string_view text) {
  return std::string(text);
}

struct ParsedParam {
  graph::ParamTag type;
  Offset line;
  std::vector<double> numbers;
};
using ParamTable = std::unordered_map<Id, ParsedParam>;

void check_finite(const Graph& graph, Offset line, const std::vector<double>& numbers) {
  for (double number : numbers) {
    if (!std::isfinite(number)) throw graph::error_at(graph, line, "a number is not finite");
  }
}

ParamTable parse_params(const Graph& graph) {
  ParamTable table;
  for (const graph::Param& param : graph.params) {
    ParsedParam parsed{param.type, param.line, {}};
    graph::param_numbers(graph, param, parsed.numbers);
    check_finite(graph, param.line, parsed.numbers);
    table.try_emplace(param.id, std::move(parsed));  // the first holds, as in g2o
  }
  return table;
}

// The pose that a parameter starts with is brought to unit length: text rounds it.
void normalize_param(const Graph& graph, graph::ParamTag wanted, ParsedParam& param) {
  if (static_cast<int>(param.numbers.size()) < graph::row(wanted).numbers) {
    throw graph::error_at(graph, param.line,
                          quoted(graph::name(param.type)) + " has too few numbers");
  }
  if (!graph::has_quaternion(graph::row(wanted).frame)) return;
  const SE3 pose = geometry::se3(param.numbers.data());
  if (pose.q.norm() < 1e-6)
    throw graph::error_at(graph, param.line, "a quaternion has length zero");
  set_se3(normalized(pose), param.numbers.data());
}

// What make_problem goes through the edges with.
struct Builder {
  const Graph& graph;
  Problem& problem;
  ParamTable params;
  std::vector<double> numbers;        // of the line at hand
  std::vector<double> last_triangle;  // of the last information matrix, to store equal ones once
};

std::array<const double*, max_ends> find_params(Builder& builder, Index e, const Model& model) {
  std::array<const double*, max_ends> found{};
  const Graph& graph = builder.graph;
  const auto ids = graph::edge_params(graph, e);
  for (std::size_t k = 0; k < model.params.size(); ++k) {
    const auto entry = builder.params.find(ids[k]);
    const graph::ParamTag wanted = model.params[k];
    if (entry == builder.params.end() || !graph::serves_as(wanted, entry->second.type)) {
      throw graph::error_at(graph, graph.edge_line[e],
                            quoted(model.tag) + " wants a " + quoted(graph::name(wanted)) +
                                " line with the id " + std::to_string(ids[k]));
    }
    normalize_param(graph, wanted, entry->second);
    found[k] = entry->second.numbers.data();
  }
  return found;
}

void check_ends(const Builder& builder, Index e, const Model& model) {
  const auto vertices = builder.graph.edge(e);
  for (int k = 0; k < model.arity; ++k) {
    if (builder.problem.space[vertices[k]] == model.ends[k]) continue;
    throw graph::error_at(builder.graph, builder.graph.edge_line[e],
                          graph::wrong_end(builder.graph, e, k));
  }
}

// Where the whitening matrix of this information stands.
Index store_whitening(Builder& builder, Index e, std::span<const double> triangle, int dim) {
  Problem& problem = builder.problem;
  if (!std::ranges::equal(triangle, builder.last_triangle)) {
    const std::size_t at = problem.whitening.size();
    problem.whitening.resize(at + dim * dim);
    if (!whitening(triangle, dim, problem.whitening.data() + at)) {
      throw graph::error_at(builder.graph, builder.graph.edge_line[e],
                            "the information matrix is not positive semidefinite");
    }
    builder.last_triangle.assign(triangle.begin(), triangle.end());
  }
  return static_cast<Index>(problem.whitening.size()) - dim * dim;
}

void read_numbers(Builder& builder, Index e, int wanted) {
  const Graph& graph = builder.graph;
  auto& numbers = builder.numbers;
  graph::edge_numbers(graph, e, numbers);
  if (static_cast<int>(numbers.size()) < wanted) {
    throw graph::error_at(graph, graph.edge_line[e],
                          graph.type_of_edge(e).tag + " wants " + std::to_string(wanted) +
                              " numbers, not " + std::to_string(numbers.size()));
  }
  check_finite(graph, graph.edge_line[e], numbers);
}

// Of the numbers at hand, behind the measurement.
void add_information(Builder& builder, Index e, int measurement, int dim) {
  const std::span<const double> information(builder.numbers.data() + measurement,
                                            static_cast<std::size_t>(geometry::triangle_size(dim)));
  builder.problem.whitening_at.push_back(store_whitening(builder, e, information, dim));
  builder.problem.diagonal.push_back(geometry::is_diagonal(information, dim));
}

double* add_constants(Problem& problem, const Model& model, int count) {
  problem.model.push_back(&model);
  problem.constants_at.push_back(static_cast<Index>(problem.constants.size()));
  problem.constants.resize(problem.constants.size() + count);
  return problem.constants.data() + problem.constants_at.back();
}

void add_linear_factor(Builder& builder, Index e, const Model& model) {
  const Graph& graph = builder.graph;
  const auto spaces = graph::end_spaces(graph, e);
  if (const std::string cause = misfit(model.type, spaces); !cause.empty())
    throw graph::error_at(graph, graph.edge_line[e], quoted(model.tag) + cause);
  const graph::LinearSize size = graph::linear_size(model.type, spaces);
  read_numbers(builder, e, size.measurement + geometry::triangle_size(size.dim));
  add_information(builder, e, size.measurement, size.dim);
  double* const constants = add_constants(builder.problem, model, linear_constants(size, spaces));
  if (!prepare_linear(model.type, spaces, builder.numbers.data(), constants))
    throw graph::error_at(graph, graph.edge_line[e], "a quaternion has length zero");
}

void add_factor(Builder& builder, Index e) {
  const Graph& graph = builder.graph;
  const Offset line = graph.edge_line[e];
  const graph::EdgeType& type = graph.type_of_edge(e);
  const Model* model = find_model(graph.edge_tag(e));
  if (!model) throw graph::error_at(graph, line, type.tag + " has no measurement model here");
  if (graph::is_linear(model->type)) return add_linear_factor(builder, e, *model);
  check_ends(builder, e, *model);

  auto& numbers = builder.numbers;
  const int triangle = geometry::triangle_size(model->dim);
  read_numbers(builder, e, model->measurement + triangle + model->extra);

  Problem& problem = builder.problem;
  add_information(builder, e, model->measurement, model->dim);
  // What the model keeps: the measurement and the numbers behind the information, together.
  numbers.erase(numbers.begin() + model->measurement,
                numbers.begin() + model->measurement + triangle);
  double* const constants = add_constants(problem, *model, model->constants);
  if (!model->prepare(numbers.data(), find_params(builder, e, *model).data(), constants)) {
    throw graph::error_at(graph, line, "a quaternion has length zero");
  }
}

void lay_out_values(Problem& problem) {
  const Graph& graph = *problem.graph;
  problem.value_at.push_back(0);
  for (Index v = 0; v < graph.vertices(); ++v) {
    const graph::Space space = graph.type_of_vertex(v).space;
    if (!has_steps(space)) {
      throw graph::error_at(graph, graph.vertex_line[v],
                            graph.type_of_vertex(v).tag + " has no measurement model here");
    }
    problem.space.push_back(space);
    problem.value_at.push_back(problem.value_at.back() + graph::space_size(space));
  }
}

// Whether the first pose has to be held, decided at the estimates of the file and, where these are
// degenerate (all at the origin), at composed ones.
bool is_free(const Problem& problem) {
  const Graph& graph = *problem.graph;
  bool anchored = false, poses = false;
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (graph.fixed[v] && graph.role(v) == graph::Role::pose) return false;
    anchored |= graph.fixed[v];
    poses |= graph.role(v) == graph::Role::pose;
  }
  if (anchored && !poses) return false;
  for (Index e = 0; e < graph.edges(); ++e) anchored |= is_anchor(problem, e);
  if (!anchored) return true;
  return !holds_gauge(problem, start_values(problem)) &&
         (graph.edges_only || !holds_gauge(problem, initial_values(problem)));
}

void lay_out_variables(Problem& problem) {
  problem.variables = graph::graph_pattern(*problem.graph);
  problem.step_at = starts(problem.variables.pattern.dim);
  if (is_free(problem)) hold_first_pose(problem);
}

}  // namespace

Problem make_problem(const Graph& graph) {
  Problem problem;
  problem.graph = &graph;
  lay_out_values(problem);
  Builder builder{graph, problem, parse_params(graph), {}, {}};
  for (Index e = 0; e < graph.edges(); ++e) add_factor(builder, e);
  lay_out_variables(problem);
  return problem;
}

Values file_values(const Problem& problem) {
  const Graph& graph = *problem.graph;
  if (graph.edges_only) throw text::input_error(graph.file, 0, "the file has no VERTEX lines");
  Values values(problem.value_at.back());
  std::vector<double> numbers;
  for (Index v = 0; v < graph.vertices(); ++v) {
    const graph::Space space = problem.space[v];
    graph::vertex_numbers(graph, v, numbers);
    check_finite(graph, graph.vertex_line[v], numbers);
    if (static_cast<int>(numbers.size()) < graph::space_size(space)) {
      throw graph::error_at(graph, graph.vertex_line[v],
                            graph.type_of_vertex(v).tag + " wants " +
                                std::to_string(graph::space_size(space)) + " numbers, not " +
                                std::to_string(numbers.size()));
    }
    if (!from_file(space, numbers.data(), values.data() + problem.value_at[v])) {
      throw graph::error_at(graph, graph.vertex_line[v], "a quaternion has length zero");
    }
  }
  return values;
}

int dim_of(const Problem& problem, Index e) {
  const Model& model = *problem.model[e];
  return model.dim > 0 ? model.dim : linear_dim(constants_of(problem, e));
}

std::vector<Index> starts(std::span<const int> dim) {
  std::vector<Index> at(dim.size() + 1, 0);
  std::partial_sum(dim.begin(), dim.end(), at.begin() + 1);
  return at;
}

void retract(const Problem& problem, const std::vector<double>& step, Values& values) {
  const auto& vertex = problem.variables.variable_vertex;
  for (std::size_t j = 0; j < vertex.size(); ++j) {
    const Index v = vertex[j];
    retract(problem.space[v], step.data() + problem.step_at[j],
            values.data() + problem.value_at[v]);
  }
}

std::vector<double> estimate_numbers(const Problem& problem, const Values& values, Index v) {
  std::vector<double> numbers(graph::space_size(problem.space[v]));
  to_file(problem.space[v], values.data() + problem.value_at[v], numbers.data());
  return numbers;
}

std::string estimate_text(const Problem& problem, const Values& values, Index v) {
  std::string text;
  text::append_numbers(text, estimate_numbers(problem, values, v));
  return text.substr(1);
}

std::string vertex_line(const Problem& problem, const Values& values, Index v) {
  const Graph& graph = *problem.graph;
  return graph.type_of_vertex(v).tag + " " + std::to_string(graph.id[v]) + " " +
         estimate_text(problem, values, v) + "\n";
}

}  // namespace sg::factor
