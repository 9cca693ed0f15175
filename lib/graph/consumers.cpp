#include "lib/graph/consumers.h"

#include <algorithm>
#include <array>
#include <limits>
#include <unordered_map>
#include <unordered_set>

#include "lib/graph/components.h"
#include "lib/text/words.h"

namespace sg::graph {
namespace {

// Findings of one kind: the first, and how many more there are.
struct Kind {
  Finding first{implied, Severity::warning, ""};
  Index count = 0;

  void add(Offset line, const std::string& cause) {
    if (count++ == 0 || line < first.line) first = {line, first.severity, cause};
  }
};

void report(Kind kind, Severity severity, Findings& findings) {
  if (kind.count == 0) return;
  kind.first.severity = severity;
  if (kind.count > 1)
    kind.first.cause += " (and so with " + std::to_string(kind.count - 1) + " more)";
  findings.push_back(std::move(kind.first));
}

std::string id_of(const Graph& graph, Index v) {
  return std::to_string(graph.id[v]);
}

// Lines ahead of the VERTEX and PARAMS lines that they name.
void check_order(const Graph& graph, Severity severity, std::string_view who, Findings& findings) {
  const std::string drops =
      ": " + std::string(who) + " drops it; put VERTEX and PARAMS lines first";
  Kind edges, params, fixes;
  std::unordered_map<Id, Offset> param_line;
  for (const Param& param : graph.params) param_line.try_emplace(param.id, param.line);
  for (Index e = 0; e < graph.edges(); ++e) {
    const Offset line = graph.edge_line[e];
    const auto ends = graph.edge(e);
    const auto ahead =
        std::ranges::find_if(ends, [&](Index v) { return graph.vertex_line[v] > line; });
    if (ahead != ends.end()) {
      edges.add(line, graph.type_of_edge(e).tag + " stands ahead of vertex " +
                          id_of(graph, *ahead) + drops);
      continue;
    }
    if (graph.type_of_edge(e).params.size == 0) continue;
    for (const Id id : edge_params(graph, e)) {
      const auto param = param_line.find(id);
      if (param == param_line.end() || param->second < line) continue;
      params.add(line, graph.type_of_edge(e).tag + " stands ahead of parameter " +
                           std::to_string(id) + drops);
      break;
    }
  }
  for (const Offset line : graph.fix_lines) {
    auto rest = line_at(graph, line);
    text::next_word(rest);
    for (auto word = text::next_word(rest); !word.empty(); word = text::next_word(rest)) {
      const auto v = find_vertex(graph, text::parse<Id>(word).value_or(-1));
      if (v && graph.vertex_line[*v] > line)
        fixes.add(line, "FIX stands ahead of vertex " + id_of(graph, *v) + drops);
    }
  }
  for (Kind* kind : {&edges, &params, &fixes}) report(std::move(*kind), severity, findings);
}

void check_ids(const Graph& graph, Severity severity, std::string_view who, Findings& findings) {
  Kind large;
  for (Index v = graph.vertices();
       v-- > 0 && graph.id[v] > std::numeric_limits<std::int32_t>::max();)
    large.add(graph.vertex_line[v], "id " + id_of(graph, v) +
                                        " is above 2^31 - 1: " + std::string(who) +
                                        " cannot load it; number the vertices anew");
  report(std::move(large), severity, findings);
}

// Lines whose tag `knows` refuses.
void check_tags(const Graph& graph, std::string_view who,
                bool (*knows)(const Graph&, std::string_view), Findings& findings) {
  std::unordered_map<std::string_view, Kind> unknown;
  const auto look = [&](Offset line) {
    auto rest = line_at(graph, line);
    const auto tag = text::next_word(rest);
    if (!knows(graph, tag))
      unknown[tag].add(line, std::string(who) + " does not read " + std::string(tag));
  };
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (graph.vertex_line[v] != implied) look(graph.vertex_line[v]);
  }
  for (const Offset line : graph.edge_line) look(line);
  for (auto& [tag, kind] : unknown) report(std::move(kind), Severity::error, findings);
}

bool g2o_knows(const Graph&, std::string_view tag) {
  const auto is = [tag](const auto& row) { return row.tag == tag; };
  if (tag == name(EdgeTag::linear) || tag == name(EdgeTag::linear_relative)) return false;
  return std::ranges::any_of(vertex_rows, is) || std::ranges::any_of(edge_rows, is);
}

// The registry's types of these, by whatever name: what is foreign was translated.
bool gtsam_knows(const Graph& graph, std::string_view tag) {
  const TagMeaning& meaning = *graph.tags.find(tag);
  constexpr std::array vertices{VertexTag::se2,      VertexTag::se3,   VertexTag::xy,
                                VertexTag::trackxyz, VertexTag::toro2, VertexTag::toro3};
  constexpr std::array edges{EdgeTag::se2, EdgeTag::se3, EdgeTag::toro2, EdgeTag::toro3};
  return meaning.kind == LineKind::vertex
             ? std::ranges::find(vertices, VertexTag{meaning.type}) != vertices.end()
             : std::ranges::find(edges, EdgeTag{meaning.type}) != edges.end();
}

bool toro_knows(const Graph& graph, std::string_view tag) {
  const TagMeaning& meaning = *graph.tags.find(tag);
  return gtsam_knows(graph, tag) &&
         (meaning.kind == LineKind::edge || graph.tags.vertices[meaning.type].role == Role::pose);
}

void check_fixes(const Graph& graph, std::string_view who, Findings& findings) {
  Kind fixes;
  for (const Offset line : graph.fix_lines)
    fixes.add(line, std::string(who) + " knows no FIX line: nothing is held");
  report(std::move(fixes), Severity::warning, findings);
}

void check_estimates(const Graph& graph, std::string_view who, Findings& findings) {
  if (!graph.edges_only) return;
  findings.push_back({implied, Severity::error,
                      "there is no VERTEX line: " + std::string(who) +
                          " drops every edge (sg-convert --estimates adds them)"});
}

void check_pairs(const Graph& graph, Findings& findings) {
  Kind again;
  std::unordered_set<std::uint64_t> pairs;
  for (Index e = 0; e < graph.edges(); ++e) {
    const auto ends = graph.edge(e);
    if (ends.size() != 2) continue;
    const auto [least, most] = std::minmax(ends[0], ends[1]);
    if (pairs.insert(static_cast<std::uint64_t>(least) << 32 | static_cast<std::uint32_t>(most))
            .second)
      continue;
    again.add(graph.edge_line[e], "a second edge between vertices " + id_of(graph, least) +
                                      " and " + id_of(graph, most) + ": TORO takes one");
  }
  report(std::move(again), Severity::error, findings);
}

void check_whole(const Graph& graph, Findings& findings) {
  const Components parts = components(graph);
  if (parts.count > 1)
    findings.push_back(
        {implied, Severity::error,
         "the graph is in " + std::to_string(parts.count) + " parts: TORO's tree reaches one"});
}

}  // namespace

std::optional<Consumer> consumer(std::string_view name) {
  if (name == "g2o") return Consumer::g2o;
  if (name == "gtsam") return Consumer::gtsam;
  if (name == "toro") return Consumer::toro;
  return std::nullopt;
}

Findings check_for(const Graph& graph, Consumer consumer) {
  Findings findings;
  switch (consumer) {
    case Consumer::any:
      check_order(graph, Severity::warning, "g2o", findings);
      check_ids(graph, Severity::warning, "g2o", findings);
      break;
    case Consumer::g2o:
      check_order(graph, Severity::error, "g2o", findings);
      check_ids(graph, Severity::error, "g2o", findings);
      check_tags(graph, "g2o", g2o_knows, findings);
      check_estimates(graph, "g2o", findings);
      break;
    case Consumer::gtsam:
      check_tags(graph, "GTSAM's readG2o", gtsam_knows, findings);
      check_fixes(graph, "GTSAM", findings);
      break;
    case Consumer::toro:
      check_order(graph, Severity::error, "TORO", findings);
      check_ids(graph, Severity::error, "TORO", findings);
      check_tags(graph, "TORO", toro_knows, findings);
      check_fixes(graph, "TORO", findings);
      check_estimates(graph, "TORO", findings);
      check_pairs(graph, findings);
      check_whole(graph, findings);
      break;
  }
  return findings;
}

}  // namespace sg::graph
