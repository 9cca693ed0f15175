#include "lib/graph/check.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/geometry/triangle.h"
#include "lib/graph/components.h"

namespace sg::graph {
namespace {

using Numbers = std::vector<double>;
using Findings = std::vector<Finding>;

std::string vertex_name(const Graph& graph, Index v) {
  return "vertex " + std::to_string(graph.id[v]);
}

bool finite(const Numbers& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}

// Of x y z qx qy qz qw ...
void check_quaternion(Offset line, const Numbers& numbers, Findings& findings) {
  const double length =
      std::hypot(std::hypot(numbers[3], numbers[4]), std::hypot(numbers[5], numbers[6]));
  if (length == 0) {
    findings.push_back({line, true, "a quaternion has length zero"});
  } else if (std::abs(length - 1) > 1e-3) {
    findings.push_back({line, false, "the quaternion's length is " + std::to_string(length)});
  }
}

bool semidefinite(const Eigen::MatrixXd& matrix) {
  if (Eigen::LLT<Eigen::MatrixXd>(matrix).info() == Eigen::Success) return true;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix, Eigen::EigenvaluesOnly);
  const double largest = solver.eigenvalues().cwiseAbs().maxCoeff();
  return solver.info() == Eigen::Success && solver.eigenvalues()[0] >= -1e-9 * largest;
}

// `numbers`: of the edge's line, as edge_numbers gives them.
void check_information(const Graph& graph, Index e, const Numbers& numbers, Findings& findings) {
  const EdgeType& type = graph.type_of_edge(e);
  if (type.measurement < 0) return;
  const auto repeats = static_cast<Index>(type.counted ? graph.edge(e).size() - 1 : 1);
  const Index measurement = repeats * type.measurement;
  const std::int64_t dim = type.counted ? measurement : type.dim;
  const auto given = static_cast<std::int64_t>(numbers.size()) - measurement;
  if (dim == 0 || given < geometry::triangle_size(dim)) return;
  const double* const w = numbers.data() + measurement;
  const auto size = static_cast<std::size_t>(geometry::triangle_size(dim));
  if (!semidefinite(geometry::symmetric<Eigen::MatrixXd>({w, size}, dim))) {
    findings.push_back({graph.edge_line[e], true,
                        "the information matrix of " + type.tag + " is not positive semidefinite"});
  }
}

void check_self_loop(const Graph& graph, Index e, Findings& findings) {
  const auto ends = graph.edge(e);
  std::vector<Index> sorted(ends.begin(), ends.end());
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice == sorted.end()) return;
  findings.push_back(
      {graph.edge_line[e], true,
       graph.type_of_edge(e).tag + " joins " + vertex_name(graph, *twice) + " to itself"});
}

void check_edges(const Graph& graph, Findings& findings) {
  Numbers numbers;
  for (Index e = 0; e < graph.edges(); ++e) {
    check_self_loop(graph, e, findings);
    edge_numbers(graph, e, numbers);
    if (!finite(numbers)) {
      findings.push_back({graph.edge_line[e], true, "a number is infinite or not a number"});
      continue;
    }
    const EdgeType& type = graph.type_of_edge(e);
    if (has_quaternion(type.space)) check_quaternion(graph.edge_line[e], numbers, findings);
    check_information(graph, e, numbers, findings);
  }
}

void check_vertices(const Graph& graph, Findings& findings) {
  Numbers numbers;
  for (Index v = 0; v < graph.vertices(); ++v) {
    const Offset line = graph.vertex_line[v];
    if (line == implied) continue;
    vertex_numbers(graph, v, numbers);
    const VertexType& type = graph.type_of_vertex(v);
    if (!finite(numbers)) {
      findings.push_back({line, true, "a number is infinite or not a number"});
    } else if (has_quaternion(type.space)) {
      check_quaternion(line, numbers, findings);
    }
  }
}

void check_params(const Graph& graph, Findings& findings) {
  Numbers numbers;
  for (const Param& param : graph.params) {
    param_numbers(graph, param, numbers);
    const bool pose = param.type != ParamTag::unknown && has_quaternion(row(param.type).frame);
    if (!finite(numbers)) {
      findings.push_back({param.line, true, "a number is infinite or not a number"});
    } else if (pose && numbers.size() >= 7) {
      check_quaternion(param.line, numbers, findings);
    }
  }
}

// One end of an edge at a landmark.
struct Sight {
  Index landmark;
  Index from;  // another vertex of the edge; the landmark itself if there is none
  int dim;
  Offset line;
};

std::vector<Sight> sights(const Graph& graph) {
  std::vector<Sight> result;
  for (Index e = 0; e < graph.edges(); ++e) {
    const EdgeType& type = graph.type_of_edge(e);
    const int known = type.counted ? type.measurement : type.dim;
    const int dim = known < 0 ? std::numeric_limits<int>::max() : known;
    for (Index v : graph.edge(e)) {
      if (graph.role(v) != Role::landmark || graph.fixed[v]) continue;
      const auto ends = graph.edge(e);
      const auto other = std::find_if(ends.begin(), ends.end(), [v](Index u) { return u != v; });
      result.push_back({v, other == ends.end() ? v : *other, dim, graph.edge_line[e]});
    }
  }
  std::stable_sort(result.begin(), result.end(), [](const Sight& a, const Sight& b) {
    return std::pair(a.landmark, a.from) < std::pair(b.landmark, b.from);
  });
  return result;
}

// Dimensions that the sights of one landmark add up to: of those from one vertex, the largest.
std::int64_t determined(std::span<const Sight> sights) {
  std::int64_t sum = 0;
  std::int64_t largest = 0;
  for (std::size_t k = 0; k < sights.size(); ++k) {
    if (k > 0 && sights[k].from != sights[k - 1].from) sum += std::exchange(largest, 0);
    largest = std::max<std::int64_t>(largest, sights[k].dim);
  }
  return sum + largest;
}

void check_landmarks(const Graph& graph, Findings& findings) {
  const std::vector<Sight> all = sights(graph);
  auto begin = all.begin();
  for (Index v = 0; v < graph.vertices(); ++v) {
    const auto end =
        std::find_if(begin, all.end(), [v](const Sight& s) { return s.landmark != v; });
    const bool unknown = graph.role(v) == Role::landmark && !graph.fixed[v];
    if (unknown && determined({begin, end}) < graph.dim(v)) {
      const Offset line = graph.vertex_line[v] == implied ? begin->line : graph.vertex_line[v];
      findings.push_back({line, true,
                          vertex_name(graph, v) + " (" + graph.type_of_vertex(v).tag +
                              ") is not determined by its observations"});
    }
    begin = end;
  }
}

// Where a vertex first stands in the file.
std::vector<Offset> first_lines(const Graph& graph) {
  std::vector<Offset> line = graph.vertex_line;
  for (Index e = graph.edges(); graph.edges_only && e-- > 0;) {
    for (Index v : graph.edge(e)) line[v] = graph.edge_line[e];
  }
  return line;
}

void check_connections(const Graph& graph, Findings& findings) {
  const Components parts = components(graph);
  if (parts.count < 2) return;
  const std::vector<Index> size = sizes(parts);
  const std::vector<Offset> line = first_lines(graph);
  const auto main = std::max_element(size.begin(), size.end()) - size.begin();
  std::vector<bool> named(parts.count, false);
  named[main] = true;
  for (Index v = 0; v < graph.vertices(); ++v) {
    const Index part = parts.of[v];
    if (named[part]) continue;
    named[part] = true;
    const std::string others =
        size[part] > 1 ? " and " + std::to_string(size[part] - 1) + " more are" : " is";
    findings.push_back(
        {line[v], false, vertex_name(graph, v) + others + " not connected to the rest"});
  }
}

}  // namespace

std::vector<Finding> check(const Graph& graph) {
  Findings findings;
  check_vertices(graph, findings);
  check_params(graph, findings);
  check_edges(graph, findings);
  check_landmarks(graph, findings);
  check_connections(graph, findings);
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return a.line < b.line; });
  return findings;
}

}  // namespace sg::graph
