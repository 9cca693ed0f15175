#include "lib/graph/graph.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <numeric>

#include "lib/text/error.h"
#include "lib/text/line.h"

namespace sg::graph {
namespace {

void parse_rest(const Graph& graph, Offset line, std::string_view rest,
                std::vector<double>& numbers) {
  numbers.clear();
  while (true) {
    const auto word = text::next_word(rest);
    if (word.empty()) return;
    const auto value = text::parse<double>(word);
    if (!value) throw error_at(graph, line, text::quoted(word) + " is not a number");
    numbers.push_back(*value);
  }
}

// The rest of a line after its tag and `words` more words.
std::string_view after(const Graph& graph, Offset line, std::size_t words) {
  auto rest = line_at(graph, line);
  for (std::size_t k = 0; k <= words; ++k) text::next_word(rest);
  return rest;
}

// Brings the six numbers of TORO's triangle into the order of its rows.
void sort_triangle(double* w) {
  std::array<double, toro_triangle.size()> rows{};
  for (std::size_t k = 0; k < rows.size(); ++k) rows[toro_triangle[k]] = w[k];
  std::copy(rows.begin(), rows.end(), w);
}

// Words between an edge's tag and its parameter ids: vertex ids, and the count of a counted edge.
std::size_t id_words(const Graph& graph, Index e) {
  return graph.edge(e).size() + (graph.type_of_edge(e).counted ? 1 : 0);
}

}  // namespace

std::optional<Index> find_vertex(const Graph& graph, Id id) {
  const auto it = std::lower_bound(graph.id.begin(), graph.id.end(), id);
  if (it == graph.id.end() || *it != id) return std::nullopt;
  return static_cast<Index>(it - graph.id.begin());
}

std::string_view line_at(const Graph& graph, Offset line) {
  assert(line != implied);
  auto rest = graph.text.view.substr(static_cast<std::size_t>(line));
  return text::next_line(rest);
}

std::size_t line_number(const Graph& graph, Offset line) {
  const auto before = graph.text.view.substr(0, static_cast<std::size_t>(line));
  return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

text::Error error_at(const Graph& graph, Offset line, const std::string& cause) {
  return text::input_error(graph.file, line == implied ? 0 : line_number(graph, line), cause);
}

void vertex_numbers(const Graph& graph, Index v, std::vector<double>& numbers) {
  parse_rest(graph, graph.vertex_line[v], after(graph, graph.vertex_line[v], 1), numbers);
}

void edge_numbers(const Graph& graph, Index e, std::vector<double>& numbers) {
  const EdgeType& type = graph.type_of_edge(e);
  const std::size_t skip = id_words(graph, e) + type.params.size;
  parse_rest(graph, graph.edge_line[e], after(graph, graph.edge_line[e], skip), numbers);
  if (type.order == Triangle::toro) sort_triangle(numbers.data() + type.measurement);
}

void param_numbers(const Graph& graph, const Param& param, std::vector<double>& numbers) {
  parse_rest(graph, param.line, after(graph, param.line, 1), numbers);
}

std::vector<Id> edge_params(const Graph& graph, Index e) {
  auto rest = after(graph, graph.edge_line[e], id_words(graph, e));
  std::vector<Id> ids(graph.type_of_edge(e).params.size);
  for (Id& id : ids) {
    const auto value = text::parse<Id>(text::next_word(rest));
    if (!value) throw error_at(graph, graph.edge_line[e], "a parameter id is missing");
    id = *value;
  }
  return ids;
}

std::optional<int> misplaced_end(const Graph& graph, Index e) {
  const EdgeType& type = graph.type_of_edge(e);
  const auto vertices = graph.edge(e);
  for (int k = 0; k < static_cast<int>(vertices.size()) && type.ends.size > 0; ++k) {
    const VertexRow& wanted = row(wanted_end(type, k));
    const VertexType& found = graph.type_of_vertex(vertices[k]);
    // What was taught has no space: its role has to do.
    if (found.space == Space::none ? found.role != wanted.role : found.space != wanted.space)
      return k;
  }
  return std::nullopt;
}

std::string wrong_end(const Graph& graph, Index e, int k) {
  const EdgeType& type = graph.type_of_edge(e);
  const Index v = graph.edge(e)[k];
  return type.tag + " joins vertex " + std::to_string(graph.id[v]) + ", a " +
         graph.type_of_vertex(v).tag + ", where it wants a " +
         std::string(name(wanted_end(type, k)));
}

void check_ends(const Graph& graph, Index e) {
  if (const auto k = misplaced_end(graph, e))
    throw error_at(graph, graph.edge_line[e], wrong_end(graph, e, *k));
}

std::vector<Index> file_order(const Graph& graph) {
  std::vector<Index> order;
  order.reserve(graph.vertices());
  if (!graph.edges_only) {
    order.resize(graph.vertices());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](Index a, Index b) { return graph.vertex_line[a] < graph.vertex_line[b]; });
    return order;
  }
  std::vector<bool> seen(graph.vertices(), false);
  for (Index v : graph.edge_vertices.items) {
    if (!seen[v]) order.push_back(v);
    seen[v] = true;
  }
  return order;
}

}  // namespace sg::graph
