#include "formats/write.h"

#include <algorithm>

#include "lib/graph/tokens.h"

namespace sg {
namespace {

bool is_data(const Graph& graph, Offset line) {
  auto rest = line_at(graph, line);
  const auto* meaning = graph.tags.find(next_word(rest));
  return meaning && meaning->kind == LineKind::data;
}

// FIX lines lose the dropped vertices; one that names no other goes.
void edit_fix_lines(const Graph& graph, const std::vector<bool>& drop_vertex,
                    std::vector<Edit>& edits) {
  for (Offset line : graph.fix_lines) {
    auto rest = line_at(graph, line);
    next_word(rest);
    std::string kept;
    bool dropped = false;
    for (auto word = next_word(rest); !word.empty(); word = next_word(rest)) {
      const auto v = find_vertex(graph, parse<Id>(word).value_or(-1));
      if (v && drop_vertex[*v]) {
        dropped = true;
      } else {
        kept += " " + std::string(word);
      }
    }
    if (!dropped) continue;
    const auto [begin, end] = line_extent(graph, line);
    const auto newline = line_at(graph, line).ends_with('\r') ? "\r\n" : "\n";
    edits.push_back({begin, end, kept.empty() ? "" : "FIX" + kept + std::string(newline)});
  }
}

// The places of dropped lines, in file order: without a replacement, thus half the size of an Edit.
struct Span {
  Offset begin;
  Offset end;
};

std::vector<Span> dropped_lines(const Graph& graph, const Changes& changes) {
  std::vector<Span> spans;
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (!changes.drop_vertex[v] || graph.vertex_line[v] == implied) continue;
    const auto [begin, end] = vertex_extent(graph, v);
    spans.push_back({begin, end});
  }
  for (Index e = 0; e < graph.edges(); ++e) {
    if (!changes.drop_edge[e]) continue;
    const auto [begin, end] = line_extent(graph, graph.edge_line[e]);
    spans.push_back({begin, end});
  }
  std::sort(spans.begin(), spans.end(),
            [](const Span& a, const Span& b) { return a.begin < b.begin; });
  return spans;
}

// The end of the comment lines at the head of the text.
Offset leading_comments(const Graph& graph) {
  Offset at = 0;
  while (at < static_cast<Offset>(graph.text.view.size())) {
    auto line = line_at(graph, at);
    if (!next_word(line).starts_with('#')) break;
    at = line_extent(graph, at).second;
  }
  return at;
}

// Lines can only follow a newline: a text whose last line lacks it gets it.
bool needs_newline(std::string_view before) {
  return !before.empty() && before.back() != '\n';
}

}  // namespace

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
  return {
      std::vector<bool>(graph.vertices(), false), std::vector<bool>(graph.edges(), false), {}, ""};
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
  std::stable_sort(edits.begin(), edits.end(),
                   [](const Edit& a, const Edit& b) { return a.begin < b.begin; });
  const std::vector<Span> dropped = dropped_lines(graph, changes);
  Offset at = 0;
  const auto copy_to = [&](Offset to) {
    if (to > at) sink.write(text.substr(at, to - at));
  };
  auto span = dropped.begin();
  for (auto edit = edits.begin(); span != dropped.end() || edit != edits.end();) {
    if (edit != edits.end() && (span == dropped.end() || edit->begin <= span->begin)) {
      copy_to(edit->begin);
      sink.write(edit->replacement);
      at = std::max(at, edit->end);
      ++edit;
    } else {
      copy_to(span->begin);
      at = std::max(at, span->end);
      ++span;
    }
  }
  copy_to(static_cast<Offset>(text.size()));
  if (changes.append.empty()) return;
  if (needs_newline(text)) sink.write("\n");
  sink.write(changes.append);
}

}  // namespace sg
