#include "formats/scale.h"

#include <cmath>

#include "lib/text/words.h"

namespace sg::formats {
namespace {

// TAG ID... PARAM... MEASUREMENT... INFORMATION... EXTRA...
std::string scaled_line(const Graph& graph, Index e, double factor) {
  const graph::EdgeType& type = graph.type_of_edge(e);
  const std::string_view line = without_return(graph::line_at(graph, graph.edge_line[e]));
  std::string_view rest = line;
  const int before = 1 + type.arity + type.params.size + type.measurement;
  for (int k = 0; k < before; ++k) text::next_word(rest);
  std::string out(line.substr(0, line.size() - rest.size()));
  for (int k = type.dim * (type.dim + 1) / 2; k > 0; --k) {
    const std::string_view blank_and_word = rest;
    const std::string_view word = text::next_word(rest);
    out += blank_and_word.substr(0, static_cast<std::size_t>(word.data() - blank_and_word.data()));
    out += text::format_number(text::parse<double>(word).value_or(0) * factor);
  }
  return out.append(rest);
}

}  // namespace

InformationScale parse_scale(const graph::Tags& tags, std::string_view text) {
  const auto refuse = [&](const std::string& cause) {
    return text::usage_error("--scale-information " + std::string(text) + ": " + cause);
  };
  const auto equals = text.find('=');
  const std::string_view tag = text.substr(0, equals);
  const auto factor =
      equals == text.npos ? std::nullopt : text::parse<double>(text.substr(equals + 1));
  if (!factor) throw refuse("wants TAG=X, as in EDGE_MINE=0.5");
  if (!std::isfinite(*factor) || !(*factor > 0)) throw refuse("the factor has to be above 0");
  const graph::TagMeaning* const meaning = tags.find(tag);
  if (!meaning || meaning->kind != graph::LineKind::edge)
    throw refuse("no edge is known by this tag");
  const graph::EdgeType& type = tags.edges[meaning->type];
  if (type.measurement < 0 || type.counted)
    throw refuse("where its lines hold information is not known here");
  return {meaning->type, *factor};
}

Changes scaled(const Graph& graph, std::span<const InformationScale> scales) {
  std::vector<double> factor(graph.tags.edges.size(), 1);
  for (const auto& scale : scales) factor[scale.type] *= scale.factor;
  Changes changes = unchanged(graph);
  changes.edge_line = [&graph, factor = std::move(factor)](Index e) -> std::optional<std::string> {
    const double by = factor[graph.edge_type[e]];
    if (by == 1) return std::nullopt;
    return scaled_line(graph, e, by);
  };
  return changes;
}

}  // namespace sg::formats
