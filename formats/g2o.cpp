#include "formats/g2o.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "lib/text/line.h"

namespace sg::formats {
namespace {

constexpr std::string_view order_comment = "# sg-order: ";

// Ids fit 32 bits nearly always. The few that don't wait in `big`, and their place holds -1 - their
// number there.
struct IdList {
  std::vector<Index> small;
  std::vector<Id> big;

  void push_back(Id id) {
    if (id <= std::numeric_limits<Index>::max()) {
      small.push_back(static_cast<Index>(id));
    } else {
      big.push_back(id);
      small.push_back(-static_cast<Index>(big.size()));
    }
  }
  Id operator[](std::size_t k) const { return small[k] >= 0 ? small[k] : big[-1 - small[k]]; }
};

struct Fix {
  Id id;
  Offset line;
};

// Line numbers of offsets that mostly ascend: each costs the text since the one before.
struct LineCounter {
  Offset at = 0;
  std::size_t number = 1;

  std::size_t operator()(std::string_view text, Offset line) {
    if (line < at) *this = {};
    number += static_cast<std::size_t>(std::count(text.begin() + at, text.begin() + line, '\n'));
    at = line;
    return number;
  }
};

// What parsing collects before ids are resolved: Graph's own arrays, vertices still in file order.
struct Parser {
  Graph graph;
  const Complaint& complaint;
  const LeaveOut& leave_out;
  std::vector<Id> left_out;  // ids of vertices that were left out, ascending in the end
  IdList edge_ids;
  std::vector<Fix> fixes;
  std::string_view last_tag;  // runs of lines share their tag: look it up once
  const graph::TagMeaning* last_meaning = nullptr;

  LineCounter line_number;

  Parser(const Complaint& complaint_, const LeaveOut& leave_out_)
      : complaint(complaint_), leave_out(leave_out_) {}

  void complain(Offset line, const std::string& cause) {
    complaint(text::input_error(graph.file, line_number(graph.text.view, line), cause));
  }
};

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
  graph.edge_begin.push_back(static_cast<Index>(parser.edge_ids.small.size()));
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
  graph.edge_begin.reserve(lines + 1);
  parser.edge_ids.small.reserve(2 * lines);
}

template <class T>
void permute(std::vector<T>& values, const std::vector<Index>& order) {
  std::vector<T> sorted(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) sorted[k] = values[order[k]];
  values = std::move(sorted);
}

// Numbers vertices by ascending id; of several with one id the first in the file stays.
void sort_vertices(Parser& parser) {
  Graph& graph = parser.graph;
  if (std::adjacent_find(graph.id.begin(), graph.id.end(), std::greater_equal<>()) ==
      graph.id.end())
    return;
  std::vector<Index> order(graph.id.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return graph.id[a] < graph.id[b]; });
  std::vector<Index> kept;
  kept.reserve(order.size());
  std::vector<Index> duplicates;
  for (Index v : order) {
    (kept.empty() || graph.id[v] != graph.id[kept.back()] ? kept : duplicates).push_back(v);
  }
  std::sort(duplicates.begin(), duplicates.end());
  for (Index v : duplicates) {
    parser.complain(graph.vertex_line[v],
                    "vertex " + std::to_string(graph.id[v]) + " is defined a second time");
  }
  permute(graph.id, kept);
  permute(graph.vertex_type, kept);
  permute(graph.vertex_line, kept);
}

// Where lines were left out: leaves out what hung on them alone, vertices that are no poses and that no
// edge joins any more.
void leave_out_bare_vertices(Parser& parser) {
  Graph& graph = parser.graph;
  std::ranges::sort(parser.left_out);
  if (graph.left_out.empty()) return;
  std::vector<Id> joined;
  for (std::size_t k = 0; k < parser.edge_ids.small.size(); ++k)
    joined.push_back(parser.edge_ids[k]);
  std::ranges::sort(joined);
  std::vector<Index> kept;
  for (Index v = 0; v < graph.vertices(); ++v) {
    const bool pose = graph.role(v) == graph::Role::pose;
    if (pose || std::ranges::binary_search(joined, graph.id[v])) {
      kept.push_back(v);
    } else {
      graph.left_out.push_back(graph.vertex_line[v]);
      parser.left_out.push_back(graph.id[v]);
    }
  }
  std::ranges::sort(parser.left_out);
  permute(graph.id, kept);
  permute(graph.vertex_type, kept);
  permute(graph.vertex_line, kept);
}

// The vertex of an id: by table where ids are dense, by bisection where they are not.
class VertexLookup {
 public:
  explicit VertexLookup(const std::vector<Id>& ids) : ids_(ids) {
    if (ids.empty()) return;
    const auto range =
        static_cast<std::uint64_t>(ids.back()) - static_cast<std::uint64_t>(ids.front());
    identity_ = range + 1 == ids.size();
    if (identity_ || range > 2 * ids.size() + 1024) return;
    table_.assign(range + 1, -1);
    for (std::size_t v = 0; v < ids.size(); ++v)
      table_[ids[v] - ids.front()] = static_cast<Index>(v);
  }
  Index operator[](Id id) const {
    if (ids_.empty() || id < ids_.front() || id > ids_.back()) return -1;
    if (identity_) return static_cast<Index>(id - ids_.front());
    if (!table_.empty()) return table_[id - ids_.front()];
    const auto it = std::lower_bound(ids_.begin(), ids_.end(), id);
    return *it == id ? static_cast<Index>(it - ids_.begin()) : -1;
  }

 private:
  const std::vector<Id>& ids_;
  std::vector<Index> table_;
  bool identity_ = false;
};

// In a file without VERTEX lines the edges say what their vertices are.
void imply_vertices(Parser& parser) {
  Graph& graph = parser.graph;
  struct Mention {
    Id id;
    graph::TypeIndex type;
    Index edge;
  };
  std::vector<Mention> mentions;
  mentions.reserve(parser.edge_ids.small.size());
  for (Index e = 0; e < graph.edges(); ++e) {
    const graph::EdgeType& type = graph.type_of_edge(e);
    if (type.ends.size == 0) {
      throw graph::error_at(
          graph, graph.edge_line[e],
          type.tag + " does not say what its vertices are, and the file has no VERTEX lines");
    }
    for (Index k = graph.edge_begin[e]; k < graph.edge_begin[e + 1]; ++k) {
      const graph::VertexTag end = type.ends[std::min(k - graph.edge_begin[e], type.ends.size - 1)];
      mentions.push_back({parser.edge_ids[k], static_cast<graph::TypeIndex>(end), e});
    }
  }
  std::stable_sort(mentions.begin(), mentions.end(),
                   [](const Mention& a, const Mention& b) { return a.id < b.id; });
  for (const Mention& mention : mentions) {
    if (graph.id.empty() || graph.id.back() != mention.id) {
      graph.id.push_back(mention.id);
      graph.vertex_type.push_back(mention.type);
    } else if (graph.vertex_type.back() != mention.type) {
      parser.complain(graph.edge_line[mention.edge],
                      "vertex " + std::to_string(mention.id) + " is " +
                          graph.tags.vertices[mention.type].tag + " here and " +
                          graph.tags.vertices[graph.vertex_type.back()].tag + " in another edge");
    }
  }
  graph.vertex_line.assign(graph.id.size(), graph::implied);
  graph.edges_only = !graph.id.empty();
}

// Turns edge ids into vertex numbers, in place; edges to undefined vertices are complained of and
// dropped.
void resolve_edges(Parser& parser, const VertexLookup& lookup) {
  Graph& graph = parser.graph;
  std::vector<Index>& vertices = parser.edge_ids.small;
  Index kept_edges = 0;
  Index kept_ids = 0;
  Index begin = 0;
  for (Index e = 0; e < graph.edges(); ++e) {
    const Index end = graph.edge_begin[e + 1];
    bool whole = true;
    bool left_out = false;
    for (Index k = begin; k < end; ++k) {
      const Id id = parser.edge_ids[k];
      const Index v = lookup[id];
      if (v < 0) {
        whole = false;
        if (std::ranges::binary_search(parser.left_out, id)) {
          left_out = true;
          continue;
        }
        parser.complain(graph.edge_line[e], graph.type_of_edge(e).tag + " joins vertex " +
                                                std::to_string(id) +
                                                ", which the file does not define");
      }
      vertices[kept_ids + (k - begin)] = v;
    }
    if (left_out) graph.left_out.push_back(graph.edge_line[e]);
    if (whole) {
      kept_ids += end - begin;
      graph.edge_type[kept_edges] = graph.edge_type[e];
      graph.edge_line[kept_edges] = graph.edge_line[e];
      graph.edge_begin[++kept_edges] = kept_ids;
    }
    begin = end;
  }
  vertices.resize(kept_ids);
  graph.edge_type.resize(kept_edges);
  graph.edge_line.resize(kept_edges);
  graph.edge_begin.resize(kept_edges + 1);
  graph.edge_vertices = std::move(vertices);
}

void resolve_fixes(Parser& parser, const VertexLookup& lookup) {
  Graph& graph = parser.graph;
  graph.fixed.assign(graph.id.size(), false);
  for (const Fix& fix : parser.fixes) {
    if (const Index v = lookup[fix.id]; v >= 0) {
      graph.fixed[v] = true;
    } else if (!std::ranges::binary_search(parser.left_out, fix.id)) {
      parser.complain(fix.line, "FIX names vertex " + std::to_string(fix.id) +
                                    ", which the file does not define");
    }
  }
}

}  // namespace

Graph parse_g2o(text::Text text, std::string file, graph::Tags tags, const Complaint& complaint,
                const LeaveOut& leave_out) {
  Parser parser(complaint, leave_out);
  parser.graph.text = std::move(text);
  parser.graph.file = std::move(file);
  parser.graph.tags = std::move(tags);
  reserve(parser);
  parser.graph.edge_begin.push_back(0);
  parse_lines(parser);
  if (parser.graph.id.empty()) {
    imply_vertices(parser);
  } else {
    sort_vertices(parser);
    leave_out_bare_vertices(parser);
  }
  const VertexLookup lookup(parser.graph.id);
  resolve_edges(parser, lookup);
  resolve_fixes(parser, lookup);
  std::ranges::sort(parser.graph.left_out);
  return std::move(parser.graph);
}

}  // namespace sg::formats
