// sg-check: what is wrong with a graph, a line a finding.
#include <algorithm>

#include "cmd/common/command.h"
#include "cmd/common/options.h"
#include "cmd/common/table.h"
#include "lib/factor/plausible.h"
#include "lib/graph/consumers.h"

using namespace sg;

namespace {

using graph::Severity;

struct Options {
  cmd::Inputs inputs;
  cmd::OutputOptions output;
  cmd::TableOptions table;
  std::string consumer;
};

struct Message {
  std::string file;
  std::size_t line;  // 0: of the whole file
  Severity severity;
  std::string cause;
};

std::string_view name(Severity severity) {
  constexpr std::array<std::string_view, 3> names{"error", "warning", "note"};
  return names[static_cast<std::size_t>(severity)];
}

// What reading and checking find in one file, by line.
std::vector<Message> messages(const std::string& path, const Options& options) {
  const std::string file = text::input_name(path);
  std::vector<Message> found;
  formats::ReadOptions read = options.inputs.options;
  read.complaint = [&](const text::Error& error) {
    found.push_back({file, error.line, Severity::error, error.what()});
  };
  text::Text source = cmd::read_text({path, read});
  const std::string_view format = formats::find_format(read, source.view).name;
  const std::size_t bytes = source.view.size();
  const Graph graph = formats::read_graph_text(std::move(source), file, read);
  cmd::note_graph(graph, format, bytes);
  cmd::stage("check");
  if (graph.vertices() == 0)
    found.push_back({file, 0, Severity::error, "there is no vertex and no edge in it"});
  graph::Findings findings = graph::check(graph);
  const auto consumer = graph::consumer(options.consumer);
  if (consumer || format == "g2o")  // whose reader would be given the text of another format?
    std::ranges::move(graph::check_for(graph, consumer.value_or(graph::Consumer::any)),
                      std::back_inserter(findings));
  if (std::ranges::none_of(findings, [](const auto& f) { return f.severity == Severity::error; }))
    std::ranges::move(factor::check_plausible(graph), std::back_inserter(findings));
  std::ranges::stable_sort(findings, {}, &graph::Finding::line);
  // Findings ascend: their numbers take one pass over the text.
  std::size_t number = 1;
  Offset at = 0;
  const std::string_view text = graph.text.view;
  for (graph::Finding& finding : findings) {
    const Offset line = std::max(at, finding.line);
    number += std::count(text.begin() + at, text.begin() + line, '\n');
    at = line;
    found.push_back({file, finding.line == graph::implied ? 0 : number, finding.severity,
                     std::move(finding.cause)});
  }
  cmd::note(std::to_string(found.size()) + " findings");
  std::ranges::stable_sort(found, {}, &Message::line);
  return found;
}

const std::vector<cmd::Column<Message>> columns{
    {"file", "The file", &Message::file},
    {"line", "Its line; none where all of it is meant",
     [](Message& m) { return m.line ? cmd::Cell(m.line) : cmd::Cell(); }},
    {"severity", "error, warning or note", [](Message& m) { return name(m.severity); }},
    {"cause", "What is wrong", &Message::cause}};

std::string text_of(const Message& found) {
  const std::string file = cmd::one_line(found.file);
  const std::string place = found.line ? file + ":" + std::to_string(found.line) : file;
  return place + ": " + std::string(name(found.severity)) + ": " + found.cause + "\n";
}

int check(const cmd::Command& command, const Options& options) {
  cmd::check_form(command.app);
  const cmd::TableOptions& form = options.table;
  const bool tabled = !form.columns.empty() || form.json || form.tsv || form.table;
  if (!tabled) cmd::refuse_table(command.app, "without -f, --json, --tsv or --table");
  cmd::Output output(options.output.path);
  std::optional<cmd::Table<Message>> table;
  if (tabled) table.emplace(form, columns, cmd::Given{}, output);
  bool errors = false;
  for (const auto& path : options.inputs.paths) {
    for (const Message& found : messages(path, options)) {
      errors = errors || found.severity == Severity::error;
      if (command.quiet && found.severity != Severity::error) continue;
      if (table) {
        table->row(found);
      } else {
        output.write(text_of(found));
      }
    }
  }
  output.commit();
  return errors ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  cmd::Command command("sg-check", "Find what is wrong with a graph: a line a finding.");
  Options options;
  cmd::add_inputs(command, options.inputs);
  command.app
      .add_option("--for", options.consumer, "Also what g2o, gtsam or toro cannot take of it")
      ->option_text("PROGRAM")
      ->check(cmd::one_of({"g2o", "gtsam", "toro"}));
  cmd::add_output(command, options.output);
  cmd::add_table(command, options.table, columns);
  return cmd::run_status(command, argc, argv, [&] { return check(command, options); });
}
