#include "formats/renumber.h"

#include <cassert>

#include "lib/text/words.h"

namespace sg::formats {
namespace {

// Passes over a line's words and replaces ids; the rest of it is copied.
class Words {
 public:
  explicit Words(std::string_view line) : line_(line), rest_(line) {}

  std::string_view next() { return text::next_word(rest_); }
  void replace(Id id) {
    const std::string_view word = next();
    const auto begin = static_cast<std::size_t>(word.data() - line_.data());
    out_ += line_.substr(copied_, begin - copied_);
    out_ += std::to_string(id);
    copied_ = begin + word.size();
  }
  bool at_end() const { return rest_.find_first_not_of(" \t\r\v\f") == rest_.npos; }
  std::string_view rest() const { return rest_; }
  std::string line() { return out_.append(line_.substr(copied_)); }

 private:
  std::string_view line_, rest_;
  std::string out_;
  std::size_t copied_ = 0;
};

Id new_param(const NewIds& ids, Id id) {
  const auto it = ids.params.find(id);
  return it == ids.params.end() ? id : it->second;
}

// TAG ID [COUNT] ID... PARAM... NUMBER...; nothing where no id changes.
std::optional<std::string> edge_line(const Graph& graph, const NewIds& ids, Index e) {
  const graph::EdgeType& type = graph.type_of_edge(e);
  const auto vertices = graph.edge(e);
  bool changes = false;
  for (const Index v : vertices) changes |= ids.vertex[v] != graph.id[v];
  if (type.params.size > 0 && !ids.params.empty()) {
    for (const Id id : graph::edge_params(graph, e)) changes |= new_param(ids, id) != id;
  }
  if (!changes) return std::nullopt;
  Words words(without_return(graph::line_at(graph, graph.edge_line[e])));
  words.next();
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    if (k == 1 && type.counted) words.next();
    words.replace(ids.vertex[vertices[k]]);
  }
  if (type.counted && vertices.size() == 1) words.next();
  for (const Id id : graph::edge_params(graph, e)) words.replace(new_param(ids, id));
  return words.line();
}

Edit line_edit(const Graph& graph, Offset line, std::string replacement) {
  const auto length = static_cast<Offset>(without_return(graph::line_at(graph, line)).size());
  return {line, line + length, std::move(replacement)};
}

// TAG ID ...
Edit renamed(const Graph& graph, Offset line, Id id) {
  Words words(without_return(graph::line_at(graph, line)));
  words.next();
  words.replace(id);
  return line_edit(graph, line, words.line());
}

Edit renamed_fix(const Graph& graph, const NewIds& ids, Offset line) {
  Words words(without_return(graph::line_at(graph, line)));
  words.next();
  while (!words.at_end()) {
    auto rest = words.rest();
    const auto v = graph::find_vertex(graph, text::parse<Id>(text::next_word(rest)).value_or(-1));
    words.replace(ids.vertex[*v]);
  }
  return line_edit(graph, line, words.line());
}

}  // namespace

NewIds same_ids(const Graph& graph) {
  return {graph.id, {}, {}};
}

NewIds counted_ids(const Graph& graph) {
  NewIds ids = same_ids(graph);
  Id next = 0;
  for (const bool poses : {true, false}) {
    for (Index v = 0; v < graph.vertices(); ++v) {
      if ((graph.role(v) == graph::Role::pose) == poses) ids.vertex[v] = next++;
    }
  }
  return ids;
}

Changes renumbered(const Graph& graph, NewIds ids) {
  assert(graph.left_out.empty());
  Changes changes = unchanged(graph);
  for (Index v = 0; v < graph.vertices() && !graph.edges_only; ++v) {
    if (ids.vertex[v] != graph.id[v])
      changes.edits.push_back(renamed(graph, graph.vertex_line[v], ids.vertex[v]));
  }
  for (const graph::Param& param : graph.params) {
    if (ids.dropped_params.contains(param.id)) {
      const auto [begin, end] = line_extent(graph, param.line);
      changes.edits.push_back({begin, end, ""});
    } else if (const Id id = new_param(ids, param.id); id != param.id) {
      changes.edits.push_back(renamed(graph, param.line, id));
    }
  }
  for (const Offset line : graph.fix_lines) changes.edits.push_back(renamed_fix(graph, ids, line));
  changes.edge_line = [&graph, ids = std::move(ids)](Index e) { return edge_line(graph, ids, e); };
  return changes;
}

}  // namespace sg::formats
