#include "formats/g2o.h"

#include <algorithm>
#include <limits>

#include "formats/g2o_parser.h"
#include "formats/thin.h"
#include "lib/text/line.h"

namespace sg::formats {
namespace {

constexpr std::string_view order_comment = "# sg-order: ";

text::Error too_large(const Graph& graph) {
  return text::input_error(graph.file, 0,
                           "more than 2^31 - 1 vertices or edge ends: the graph is too large");
}

// Checks that the rest of the line is numbers, `needed` of them or more (-1: any count).
void check_numbers(std::string_view line, std::int64_t needed, std::string_view tag) {
  std::int64_t count = 0;
  while (true) {
    while (text::take_plain_number(line)) ++count;
    const auto word = text::next_word(line);
    if (word.empty()) break;
    if (!text::parse<double>(word)) throw text::BadLine{text::quoted(word) + " is not a number"};
    ++count;
  }
  if (count < needed) {
    throw text::BadLine{std::string(tag) + " wants " + std::to_string(needed) +
                        " numbers here, the line has " + std::to_string(count)};
  }
}

void parse_vertex(Parser& parser, graph::TypeIndex type_index, Offset at, std::string_view rest) {
  const graph::VertexType& type = parser.graph.tags.vertices[type_index];
  const Id id = text::read_id(rest, "a vertex id");
  check_numbers(rest, type.numbers, type.tag);
  if (parser.graph.id.size() == std::numeric_limits<Index>::max()) throw too_large(parser.graph);
  parser.graph.id.push_back(id);
  parser.graph.vertex_type.push_back(type_index);
  parser.graph.vertex_line.push_back(at);
}

// The ids of an edge line, onto parser.edge_ids; returns how many numbers have to follow.
std::int64_t parse_edge_ids(Parser& parser, const graph::EdgeType& type, std::string_view& rest) {
  if (!type.counted) {
    for (int k = 0; k < type.arity; ++k)
      parser.edge_ids.push_back(text::read_id(rest, "a vertex id"));
    return type.numbers;
  }
  parser.edge_ids.push_back(text::read_id(rest, "a vertex id"));
  const Id count = text::read_id(rest, "the number of vertices");
  if (count > static_cast<Id>(rest.size()))
    throw text::BadLine{"the line ends before its " + std::to_string(count) + " vertex ids"};
  for (Id k = 0; k < count; ++k) parser.edge_ids.push_back(text::read_id(rest, "a vertex id"));
  return type.numbers < 0 ? -1 : count * type.numbers;
}

void parse_edge(Parser& parser, graph::TypeIndex type_index, Offset at, std::string_view rest) {
  Graph& graph = parser.graph;
  const graph::EdgeType& type = graph.tags.edges[type_index];
  const std::size_t first = parser.edge_ids.small.size();
  try {
    const std::int64_t numbers = parse_edge_ids(parser, type, rest);
    for (int k = 0; k < type.params.size; ++k) text::read_id(rest, "a parameter id");
    check_numbers(rest, numbers, type.tag);
  } catch (const text::BadLine&) {
    parser.edge_ids.small.resize(first);
    throw;
  }
  if (parser.edge_ids.small.size() > std::numeric_limits<Index>::max()) throw too_large(graph);
  graph.edge_type.push_back(type_index);
  graph.edge_line.push_back(at);
  graph.edge_vertices.begin.push_back(static_cast<Index>(parser.edge_ids.small.size()));
}

void parse_param(Parser& parser, graph::ParamTag type, Offset at, std::string_view tag,
                 std::string_view rest) {
  const Id id = text::read_id(rest, "a parameter id");
  check_numbers(rest, 0, tag);
  parser.graph.params.push_back({id, type, at});
}

void parse_fix(Parser& parser, Offset at, std::string_view rest) {
  std::vector<Fix> fixes;
  do {
    fixes.push_back({text::read_id(rest, "a vertex id"), at});
    while (!rest.empty() && text::is_blank(rest.front())) rest.remove_prefix(1);
  } while (!rest.empty());
  parser.fixes.insert(parser.fixes.end(), fixes.begin(), fixes.end());
  parser.graph.fix_lines.push_back(at);
}

void parse_comment(Parser& parser, Offset at, std::string_view comment) {
  if (!comment.starts_with(order_comment)) return;
  comment.remove_prefix(order_comment.size());
  parser.graph.order_method = text::next_word(comment);
  // "colamd, until sg-dec changed the graph": no longer an order of what is there.
  if (parser.graph.order_method.ends_with(',')) parser.graph.order_method.clear();
  parser.graph.order_lines.push_back(at);
}

// A line that is not read. If it may define a vertex, edges to that go with it.
void leave_out(Parser& parser, Offset at, std::string_view tag, std::string_view rest) {
  parser.graph.left_out.push_back(at);
  const auto id = text::parse<Id>(text::next_word(rest));
  if (id && tag.find("VERTEX") != tag.npos) parser.left_out.push_back(*id);
}

void parse_line(Parser& parser, Offset at, std::string_view line) {
  auto rest = line;
  const auto tag = text::next_word(rest);
  if (tag.empty()) return;
  if (tag.front() == '#') return parse_comment(parser, at, line.substr(tag.data() - line.data()));
  if (tag != parser.last_tag) {
    parser.last_meaning = parser.graph.tags.find(tag);
    parser.last_tag = tag;
  }
  if (!parser.last_meaning && parser.leave_out.unknown_tags)
    return leave_out(parser, at, tag, rest);
  if (!parser.last_meaning)
    throw text::BadLine{"unknown tag " + text::quoted(tag) +
                        " (teach it by --vertex, --edge or --params, or --alias it to a known one; "
                        "--skip-unknown leaves such lines out)"};
  const graph::TypeIndex type = parser.last_meaning->type;
  switch (parser.last_meaning->kind) {
    case graph::LineKind::vertex:
      return parse_vertex(parser, type, at, rest);
    case graph::LineKind::edge:
      if (parser.leave_out.unknown_tags && parser.leave_out.unknown_edge &&
          parser.leave_out.unknown_edge(graph::EdgeTag{type}))
        return leave_out(parser, at, tag, rest);
      return parse_edge(parser, type, at, rest);
    case graph::LineKind::fix:
      return parse_fix(parser, at, rest);
    case graph::LineKind::param:
      return parse_param(parser, graph::ParamTag{type}, at, tag, rest);
    case graph::LineKind::data:
      return;
  }
}

void parse_lines(Parser& parser) {
  const std::string_view text = parser.graph.text.view;
  for (std::string_view rest = text; !rest.empty();) {
    const std::string_view line = text::next_line(rest);
    const Offset at = line.data() - text.data();
    try {
      parse_line(parser, at, line);
    } catch (const text::BadLine& bad) {
      parser.complain(at, bad.cause);
    }
  }
}

// Whether the edge that is behind so many others is one whose line nobody will look at.
bool goes(const Graph& graph, Index edges_before, const Thin& thin) {
  return graph.edges() > edges_before && !graph.id.empty() && edges_before >= thin.first &&
         edges_before % thin.every != 0;
}

// An empty line stays of a line that goes: those behind it have their numbers by it.
void parse_thinly(Parser& parser, std::string_view lines, const Thin& thin, std::string& kept) {
  while (!lines.empty()) {
    const std::string_view line = text::next_line(lines);
    const auto at = static_cast<Offset>(kept.size());
    const Index edges = parser.graph.edges();
    try {
      parse_line(parser, at, line);
    } catch (const text::BadLine& bad) {
      parser.graph.text.view = kept;
      parser.complain(at, bad.cause);
    }
    if (!goes(parser.graph, edges, thin)) kept += line;
    kept += '\n';
  }
  parser.last_tag = {};  // it pointed there
}

// Address space for arrays that never move: pages are only touched as they fill.
void reserve(Parser& parser) {
  const std::string_view text = parser.graph.text.view;
  const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
  Graph& graph = parser.graph;
  graph.id.reserve(lines);
  graph.vertex_type.reserve(lines);
  graph.vertex_line.reserve(lines);
  graph.edge_type.reserve(lines);
  graph.edge_line.reserve(lines);
  graph.edge_vertices.begin.reserve(lines + 1);
  parser.edge_ids.small.reserve(2 * lines);
}

}  // namespace

Graph parse_g2o(text::Text text, std::string file, graph::Tags tags, const Complaint& complaint,
                const LeaveOut& leave_out) {
  Parser parser(complaint, leave_out);
  parser.graph.text = std::move(text);
  parser.graph.file = std::move(file);
  parser.graph.tags = std::move(tags);
  reserve(parser);
  parse_lines(parser);
  resolve_ids(parser);
  return std::move(parser.graph);
}

Graph parse_g2o_thinly(const std::function<std::string_view()>& next_block, std::string file,
                       graph::Tags tags, const Complaint& complaint, const LeaveOut& leave_out,
                       const Thin& thin) {
  Parser parser(complaint, leave_out);
  parser.graph.file = std::move(file);
  parser.graph.tags = std::move(tags);
  std::string kept, begun;  // a line whose end is yet to come
  for (std::string_view block = next_block(); !block.empty(); block = next_block()) {
    const std::size_t first = block.find('\n') + 1, last = block.rfind('\n') + 1;
    if (first == 0) {
      begun += block;
      continue;
    }
    begun += block.substr(0, first);
    parse_thinly(parser, begun, thin, kept);
    parse_thinly(parser, block.substr(first, last - first), thin, kept);
    begun = block.substr(last);
  }
  parse_thinly(parser, begun, thin, kept);
  parser.graph.text = text::text_of(std::move(kept));
  resolve_ids(parser);
  return std::move(parser.graph);
}

}  // namespace sg::formats
