#include "cmd/check/findings.h"

#include <algorithm>

#include "lib/factor/plausible.h"
#include "lib/graph/consumers.h"

namespace sg::check {

using graph::Severity;

std::string_view name(Severity severity) {
  constexpr std::array<std::string_view, 3> names{"error", "warning", "note"};
  return names[static_cast<std::size_t>(severity)];
}

const std::vector<cmd::Column<Message>> columns{
    {"file", "The file", &Message::file},
    {"line", "Its line; none where all of it is meant",
     [](Message& m) { return m.line ? cmd::Cell(m.line) : cmd::Cell(); }},
    {"severity", "error, warning or note", [](Message& m) { return name(m.severity); }},
    {"cause", "What is wrong", &Message::cause}};

std::vector<Message> findings(const Graph& graph, std::string_view format,
                              std::string_view consumer) {
  std::vector<Message> found;
  if (graph.vertices() == 0)
    found.push_back({graph.file, 0, Severity::error, "there is no vertex and no edge in it"});
  graph::Findings all = graph::check(graph);
  const auto program = graph::consumer(consumer);
  if (program || format == "g2o")  // whose reader would be given the text of another format?
    std::ranges::move(graph::check_for(graph, program.value_or(graph::Consumer::any)),
                      std::back_inserter(all));
  if (std::ranges::none_of(all, [](const auto& f) { return f.severity == Severity::error; }))
    std::ranges::move(factor::check_plausible(graph), std::back_inserter(all));
  std::ranges::stable_sort(all, {}, &graph::Finding::line);
  // Findings ascend: their numbers take one pass over the text.
  std::size_t number = 1;
  Offset at = 0;
  const std::string_view text = graph.text.view;
  for (graph::Finding& finding : all) {
    const Offset line = std::max(at, finding.line);
    number += std::count(text.begin() + at, text.begin() + line, '\n');
    at = line;
    found.push_back({graph.file, finding.line == graph::implied ? 0 : number, finding.severity,
                     std::move(finding.cause)});
  }
  return found;
}

}  // namespace sg::check
