#include "lib/graph/check.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "lib/geometry/triangle.h"
#include "lib/graph/components.h"
#include "lib/graph/linear.h"

namespace sg::graph {
namespace {

using Numbers = std::vector<double>;

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
    findings.push_back({line, Severity::error, "a quaternion has length zero"});
  } else if (std::abs(length - 1) > 1e-3) {
    findings.push_back(
        {line, Severity::warning, "the quaternion's length is " + std::to_string(length)});
  }
}

bool semidefinite(const Eigen::MatrixXd& matrix) {
  if (Eigen::LLT<Eigen::MatrixXd>(matrix).info() == Eigen::Success) return true;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix, Eigen::EigenvaluesOnly);
  const double largest = solver.eigenvalues().cwiseAbs().maxCoeff();
  return solver.info() == Eigen::Success && solver.eigenvalues()[0] >= -1e-9 * largest;
}

// How many numbers the measurement of an edge has, -1 where that is not known, and the dimension of its error.
struct Sizes {
  Index measurement;
  std::int64_t dim;
};
Sizes sizes(const Graph& graph, Index e) {
  const EdgeType& type = graph.type_of_edge(e);
  if (is_linear(graph.edge_tag(e))) {
    const LinearSize size = linear_size(graph.edge_tag(e), end_spaces(graph, e));
    return {size.measurement, size.dim};
  }
  if (type.measurement < 0 || !type.counted) return {type.measurement, type.dim};
  const Index all = static_cast<Index>(graph.edge(e).size() - 1) * type.measurement;
  return {all, all};
}

// `numbers`: of the edge's line, as edge_numbers gives them.
void check_information(const Graph& graph, Index e, const Numbers& numbers, Findings& findings) {
  const EdgeType& type = graph.type_of_edge(e);
  const auto [measurement, dim] = sizes(graph, e);
  if (measurement < 0) return;
  const auto given = static_cast<std::int64_t>(numbers.size()) - measurement;
  if (dim == 0 || given < geometry::triangle_size(dim)) return;
  const double* const w = numbers.data() + measurement;
  const auto size = static_cast<std::size_t>(geometry::triangle_size(dim));
  if (!semidefinite(geometry::symmetric<Eigen::MatrixXd>({w, size}, dim))) {
    findings.push_back({graph.edge_line[e], Severity::error,
                        "the information matrix of " + type.tag + " is not positive semidefinite"});
  }
}

// "three", as a person writes it.
std::string counted(std::int64_t number) {
  constexpr std::array<std::string_view, 13> words{"no",   "one",    "two",   "three", "four",
                                                   "five", "six",    "seven", "eight", "nine",
                                                   "ten",  "eleven", "twelve"};
  return number < std::ssize(words) ? std::string(words[number]) : std::to_string(number);
}

// What stands behind the last number that the type knows is not read by anybody.
void check_count(Offset line, std::string_view tag, std::int64_t found, std::int64_t wanted,
                 Findings& findings, std::string_view remark = "") {
  if (wanted < 0 || found <= wanted) return;
  const std::int64_t more = found - wanted;
  findings.push_back({line, Severity::warning,
                      counted(more) + (more == 1 ? " number too many (" : " numbers too many (") +
                          std::string(tag) + " has " + std::to_string(wanted) + ")" +
                          std::string(remark)});
}

void check_edge_count(const Graph& graph, Index e, const Numbers& numbers, Findings& findings) {
  const EdgeType& type = graph.type_of_edge(e);
  if (type.counted || type.numbers < 0) return;
  const auto whole = std::size_t(type.measurement) + std::size_t(type.dim) * std::size_t(type.dim);
  check_count(graph.edge_line[e], type.tag, std::ssize(numbers), type.numbers, findings,
              type.dim > 1 && numbers.size() == whole
                  ? ": a whole matrix where its upper triangle belongs is read wrongly"
                  : "");
}

void check_ends(const Graph& graph, Index e, Findings& findings) {
  if (const auto k = misplaced_end(graph, e))
    findings.push_back({graph.edge_line[e], Severity::error, wrong_end(graph, e, *k)});
}

// By id; of several the first.
using Params = std::unordered_map<Id, const Param*>;

Params first_params(const Graph& graph, Findings& findings) {
  Params first;
  for (const Param& param : graph.params) {
    const auto [place, added] = first.try_emplace(param.id, &param);
    if (added) continue;
    findings.push_back({param.line, Severity::error,
                        "parameter " + std::to_string(param.id) +
                            " is given a second time: the first holds (line " +
                            std::to_string(line_number(graph, place->second->line)) + ")"});
  }
  return first;
}

void check_edge_params(const Graph& graph, Index e, const Params& params, Findings& findings) {
  const EdgeType& type = graph.type_of_edge(e);
  if (type.params.size == 0) return;
  const std::vector<Id> ids = edge_params(graph, e);
  for (int k = 0; k < type.params.size; ++k) {
    const auto param = params.find(ids[k]);
    if (param != params.end() && serves_as(type.params[k], param->second->type)) continue;
    findings.push_back(
        {graph.edge_line[e], Severity::error,
         type.tag + " wants a " + std::string(name(type.params[k])) + " line with the id " +
             std::to_string(ids[k]) +
             (param == params.end() ? ", and there is none" : ", which is another kind")});
  }
}

void check_self_loop(const Graph& graph, Index e, Findings& findings) {
  const auto ends = graph.edge(e);
  std::vector<Index> sorted(ends.begin(), ends.end());
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice == sorted.end()) return;
  findings.push_back(
      {graph.edge_line[e], Severity::error,
       graph.type_of_edge(e).tag + " joins " + vertex_name(graph, *twice) + " to itself"});
}

bool information_is_zero(const EdgeType& type, const Numbers& numbers) {
  if (type.measurement < 0 || type.counted || type.dim < 0) return false;
  const auto begin =
      numbers.begin() + std::min<std::ptrdiff_t>(type.measurement, std::ssize(numbers));
  const auto size =
      std::min<std::ptrdiff_t>(geometry::triangle_size(type.dim), numbers.end() - begin);
  return size > 0 && std::all_of(begin, begin + size, [](double w) { return w == 0; });
}

// Edges of information zero tie nothing: what hangs on them alone is loose.
void check_zero_information(const Graph& graph, const std::vector<Index>& zero,
                            Findings& findings) {
  std::vector<bool> held = graph.fixed;
  std::size_t next = 0;
  for (Index e = 0; e < graph.edges() && !zero.empty(); ++e) {
    if (next < zero.size() && zero[next] == e) {
      ++next;
    } else {
      for (const Index v : graph.edge(e)) held[v] = true;
    }
  }
  for (const Index e : zero) {
    std::string loose;
    for (const Index v : graph.edge(e)) {
      if (!held[v]) loose += (loose.empty() ? ", and " : " and ") + vertex_name(graph, v);
    }
    if (!loose.empty()) loose += " has no other edge";
    findings.push_back(
        {graph.edge_line[e], Severity::warning,
         "the information of " + graph.type_of_edge(e).tag + " is zero: it ties nothing" + loose});
  }
}

void check_edges(const Graph& graph, Findings& findings) {
  const Params params = first_params(graph, findings);
  std::vector<Index> zero;
  Numbers numbers;
  for (Index e = 0; e < graph.edges(); ++e) {
    check_self_loop(graph, e, findings);
    check_ends(graph, e, findings);
    check_edge_params(graph, e, params, findings);
    edge_numbers(graph, e, numbers);
    check_edge_count(graph, e, numbers, findings);
    if (!finite(numbers)) {
      findings.push_back(
          {graph.edge_line[e], Severity::error, "a number is infinite or not a number"});
      continue;
    }
    const EdgeType& type = graph.type_of_edge(e);
    if (has_quaternion(type.space)) check_quaternion(graph.edge_line[e], numbers, findings);
    if (information_is_zero(type, numbers)) {
      zero.push_back(e);
    } else {
      check_information(graph, e, numbers, findings);
    }
  }
  check_zero_information(graph, zero, findings);
}

void check_vertices(const Graph& graph, Findings& findings) {
  Numbers numbers;
  for (Index v = 0; v < graph.vertices(); ++v) {
    const Offset line = graph.vertex_line[v];
    if (line == implied) continue;
    vertex_numbers(graph, v, numbers);
    const VertexType& type = graph.type_of_vertex(v);
    check_count(line, type.tag, std::ssize(numbers), type.numbers, findings);
    if (!finite(numbers)) {
      findings.push_back({line, Severity::error, "a number is infinite or not a number"});
    } else if (has_quaternion(type.space)) {
      check_quaternion(line, numbers, findings);
    }
  }
}

void check_params(const Graph& graph, Findings& findings) {
  Numbers numbers;
  for (const Param& param : graph.params) {
    param_numbers(graph, param, numbers);
    const bool known = param.type != ParamTag::unknown;
    const bool pose = known && has_quaternion(row(param.type).frame);
    if (known)
      check_count(param.line, name(param.type), std::ssize(numbers), row(param.type).numbers,
                  findings);
    if (!finite(numbers)) {
      findings.push_back({param.line, Severity::error, "a number is infinite or not a number"});
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
      findings.push_back({line, Severity::error,
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
    findings.push_back({line[v], Severity::warning,
                        vertex_name(graph, v) + others + " not connected to the rest"});
  }
}

}  // namespace

Findings check(const Graph& graph) {
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
