// sg-check: what is wrong with a graph, a line a finding.
#include <algorithm>

#include "cmd/check/findings.h"
#include "cmd/common/command.h"
#include "cmd/common/options.h"
#include "cmd/common/table.h"

using namespace sg;

namespace {

using graph::Severity;

struct Options {
  cmd::Inputs inputs;
  cmd::OutputOptions output;
  cmd::TableOptions table;
  std::string consumer;
};

// What reading and checking find in one file, by line.
std::vector<check::Message> messages(const std::string& path, const Options& options) {
  const std::string file = text::input_name(path);
  std::vector<check::Message> found;
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
  std::ranges::move(check::findings(graph, format, options.consumer), std::back_inserter(found));
  cmd::note(std::to_string(found.size()) + " findings");
  std::ranges::stable_sort(found, {}, &check::Message::line);
  return found;
}

std::string text_of(const check::Message& found) {
  const std::string file = cmd::one_line(found.file);
  const std::string place = found.line ? file + ":" + std::to_string(found.line) : file;
  return place + ": " + std::string(check::name(found.severity)) + ": " + found.cause + "\n";
}

int run(const cmd::Command& command, const Options& options) {
  cmd::check_form(command.app);
  const cmd::TableOptions& form = options.table;
  const bool tabled = !form.columns.empty() || form.json || form.tsv || form.table;
  if (!tabled) cmd::refuse_table(command.app, "without -f, --json, --tsv or --table");
  cmd::Output output(options.output.path);
  std::optional<cmd::Table<check::Message>> table;
  if (tabled) table.emplace(form, check::columns, cmd::Given{}, output);
  bool errors = false;
  for (const auto& path : options.inputs.paths) {
    for (const check::Message& found : messages(path, options)) {
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
  cmd::add_table(command, options.table, check::columns);
  return cmd::run_status(command, argc, argv, [&] { return run(command, options); });
}
