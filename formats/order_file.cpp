#include "formats/order_file.h"

#include <algorithm>
#include <utility>

#include "lib/text/error.h"
#include "lib/text/line.h"

namespace sg::formats {
namespace {

struct Reader {
  const std::string& file;
  const Graph& graph;
  const graph::GraphPattern& variables;
  std::vector<bool> named;  // of every vertex
  bool first = true;        // no line has counted yet
  graph::Order order{};
};

void read_line(Reader& reader, std::size_t number, std::string_view line) {
  const auto word = text::next_word(line);
  if (word.empty() || word.front() == '#') return;
  const bool may_be_headline = std::exchange(reader.first, false);
  const auto id = text::parse<Id>(word);
  if (!id && may_be_headline) return;
  const auto fail = [&](const std::string& cause) {
    throw text::input_error(reader.file, number, cause);
  };
  if (!id) fail(text::quoted(word) + " is no vertex id");
  const auto v = graph::find_vertex(reader.graph, *id);
  if (!v) fail("vertex " + std::to_string(*id) + " is not in the graph");
  if (reader.named[*v]) fail("vertex " + std::to_string(*id) + " is named a second time");
  reader.named[*v] = true;
  if (const Index j = reader.variables.vertex_variable[*v]; j >= 0) reader.order.push_back(j);
}

void check_complete(const Reader& reader) {
  const auto missing = reader.variables.variable_vertex.size() - reader.order.size();
  if (missing == 0) return;
  const auto& variables = reader.variables.variable_vertex;
  const auto v =
      *std::find_if(variables.begin(), variables.end(), [&](Index u) { return !reader.named[u]; });
  std::string cause = "vertex " + std::to_string(reader.graph.id[v]);
  if (missing > 1) cause += " and " + std::to_string(missing - 1) + " more of the graph";
  throw text::input_error(reader.file, 0,
                          cause + (missing > 1 ? " are" : " is") + " not in the order");
}

}  // namespace

graph::Order parse_order(std::string_view text, const std::string& file, const Graph& graph,
                         const graph::GraphPattern& variables) {
  Reader reader{file, graph, variables, std::vector<bool>(graph.vertices(), false)};
  for (std::size_t number = 1; !text.empty(); ++number) {
    read_line(reader, number, text::next_line(text));
  }
  check_complete(reader);
  return std::move(reader.order);
}

}  // namespace sg::formats
