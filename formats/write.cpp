#include "formats/write.h"

#include <algorithm>
#include <numeric>

#include "lib/text/words.h"

namespace sg::formats {
namespace {

bool is_data(const Graph& graph, Offset line) {
  auto rest = graph::line_at(graph, line);
  const auto* meaning = graph.tags.find(text::next_word(rest));
  return meaning && meaning->kind == graph::LineKind::data;
}

// FIX lines lose the dropped vertices; one that names no other goes.
void edit_fix_lines(const Graph& graph, const std::vector<bool>& drop_vertex,
                    std::vector<Edit>& edits) {
  for (Offset line : graph.fix_lines) {
    auto rest = graph::line_at(graph, line);
    text::next_word(rest);
    std::string kept;
    bool dropped = false;
    for (auto word = text::next_word(rest); !word.empty(); word = text::next_word(rest)) {
      const auto v = graph::find_vertex(graph, text::parse<Id>(word).value_or(-1));
      if (v ? drop_vertex[*v] : !graph.left_out.empty()) {
        dropped = true;
      } else {
        kept += " " + std::string(word);
      }
    }
    if (!dropped) continue;
    const auto [begin, end] = line_extent(graph, line);
    const auto newline = graph::line_at(graph, line).ends_with('\r') ? "\r\n" : "\n";
    edits.push_back({begin, end, kept.empty() ? "" : std::string(graph::fix_tag) + kept + newline});
  }
}

// Vertices with a line, in the order of their lines; empty where that is the order of their ids.
std::vector<Index> line_order(const Graph& graph) {
  if (graph.edges_only || std::is_sorted(graph.vertex_line.begin(), graph.vertex_line.end()))
    return {};
  std::vector<Index> order(graph.vertices());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return graph.vertex_line[a] < graph.vertex_line[b]; });
  return order;
}

// The changes to vertices and edges as edits in file order, one at a time.
class LineEdits {
 public:
  LineEdits(const Graph& graph, const Changes& changes)
      : graph_(graph), changes_(changes), order_(line_order(graph)) {
    if (graph.edges_only) v_ = graph.vertices();
    next_vertex();
    next_edge();
  }

  const Edit* next() {
    const bool vertex = vertex_ && (!edge_ || vertex_->begin < edge_->begin);
    if (!vertex && !edge_) return nullptr;
    edit_ = std::move(vertex ? *vertex_ : *edge_);
    vertex ? next_vertex() : next_edge();
    return &edit_;
  }

 private:
  void next_vertex() {
    vertex_.reset();
    for (; v_ < graph_.vertices() && !vertex_; ++v_) {
      const Index v = order_.empty() ? v_ : order_[v_];
      if (!changes_.drop_vertex[v]) continue;
      const auto [begin, end] = vertex_extent(graph_, v);
      vertex_ = Edit{begin, end, ""};
    }
  }

  void next_edge() {
    edge_.reset();
    for (; e_ < graph_.edges() && !edge_; ++e_) {
      const bool late = !changes_.late_edge.empty() && changes_.late_edge[e_];
      const Offset begin = graph_.edge_line[e_];
      if (changes_.drop_edge[e_] || late) {
        edge_ = Edit{begin, line_extent(graph_, begin).second, ""};
      } else if (auto line = changes_.edge_line ? changes_.edge_line(e_) : std::nullopt) {
        const std::string_view old = without_return(graph::line_at(graph_, begin));
        edge_ = Edit{begin, begin + static_cast<Offset>(old.size()), std::move(*line)};
      }
    }
  }

  const Graph& graph_;
  const Changes& changes_;
  std::vector<Index> order_;
  Index v_ = 0;
  Index e_ = 0;
  std::optional<Edit> vertex_;
  std::optional<Edit> edge_;
  Edit edit_{};
};

void write_late_edges(const Graph& graph, const Changes& changes, Sink& sink) {
  for (Index e = 0; e < static_cast<Index>(changes.late_edge.size()); ++e) {
    if (!changes.late_edge[e] || changes.drop_edge[e]) continue;
    const auto line = changes.edge_line ? changes.edge_line(e) : std::nullopt;
    sink.write(line ? *line : graph::line_at(graph, graph.edge_line[e]));
    sink.write("\n");
  }
}

// The end of the comment lines at the head of the text.
Offset leading_comments(const Graph& graph) {
  Offset at = 0;
  while (at < static_cast<Offset>(graph.text.view.size())) {
    auto line = graph::line_at(graph, at);
    if (!text::next_word(line).starts_with('#')) break;
    at = line_extent(graph, at).second;
  }
  return at;
}

// Lines can only follow a newline: a text whose last line lacks it gets it.
bool needs_newline(std::string_view before) {
  return !before.empty() && before.back() != '\n';
}

}  // namespace

std::string_view without_return(std::string_view line) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::pair<Offset, Offset> line_extent(const Graph& graph, Offset line) {
  const auto end = graph.text.view.find('\n', static_cast<std::size_t>(line));
  return {line,
          static_cast<Offset>(end == std::string_view::npos ? graph.text.view.size() : end + 1)};
}

std::pair<Offset, Offset> vertex_extent(const Graph& graph, Index v) {
  auto [begin, end] = line_extent(graph, graph.vertex_line[v]);
  while (end < static_cast<Offset>(graph.text.view.size()) && is_data(graph, end)) {
    end = line_extent(graph, end).second;
  }
  return {begin, end};
}

Changes unchanged(const Graph& graph) {
  Changes changes;
  changes.drop_vertex.assign(graph.vertices(), false);
  changes.drop_edge.assign(graph.edges(), false);
  return changes;
}

void write_changed(const Graph& graph, Changes changes, std::string_view comment, Sink& sink) {
  const std::string_view text = graph.text.view;
  auto& edits = changes.edits;
  if (!comment.empty()) {
    const Offset at = leading_comments(graph);
    const bool newline = needs_newline(text.substr(0, static_cast<std::size_t>(at)));
    edits.insert(edits.begin(), {at, at, (newline ? "\n" : "") + std::string(comment)});
  }
  edit_fix_lines(graph, changes.drop_vertex, edits);
  for (const Offset line : graph.left_out)
    edits.push_back({line, line_extent(graph, line).second, ""});
  std::stable_sort(edits.begin(), edits.end(),
                   [](const Edit& a, const Edit& b) { return a.begin < b.begin; });
  Offset at = 0;
  const auto apply = [&](const Edit& edit) {
    if (edit.begin > at) sink.write(text.substr(at, edit.begin - at));
    sink.write(edit.replacement);
    at = std::max(at, edit.end);
  };
  LineEdits lines(graph, changes);
  auto edit = edits.begin();
  while (const Edit* line = lines.next()) {
    for (; edit != edits.end() && edit->begin <= line->begin; ++edit) apply(*edit);
    apply(*line);
  }
  for (; edit != edits.end(); ++edit) apply(*edit);
  sink.write(text.substr(at));
  const bool late = std::find(changes.late_edge.begin(), changes.late_edge.end(), true) !=
                    changes.late_edge.end();
  if (!late && changes.append.empty()) return;
  if (needs_newline(text)) sink.write("\n");
  write_late_edges(graph, changes, sink);
  sink.write(changes.append);
}

}  // namespace sg::formats
