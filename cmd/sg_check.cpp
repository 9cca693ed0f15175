// sg-check: what is wrong with a graph, a line a finding.
#include <algorithm>

#include "cmd/common/command.h"
#include "lib/graph/check.h"

using namespace sg;

namespace {

struct Message {
  std::size_t line;
  bool error;
  std::string cause;
};

// What reading and checking find in one file, by line.
std::vector<Message> messages(const std::string& path, formats::ReadOptions options) {
  std::vector<Message> found;
  options.complaint = [&](const text::Error& error) {
    found.push_back({error.line, true, error.what()});
  };
  cmd::begin_reading(path);
  text::Text source = text::read_text(path);
  const std::string_view format = formats::find_format(options, source.view).name;
  const std::size_t bytes = source.view.size();
  const Graph graph = formats::read_graph_text(std::move(source), text::input_name(path), options);
  cmd::note_graph(graph, format, bytes);
  cmd::stage("check");
  if (graph.vertices() == 0) found.push_back({0, true, "there is no vertex and no edge in it"});
  // Findings ascend: their numbers take one pass over the text.
  std::size_t number = 1;
  Offset at = 0;
  const std::string_view text = graph.text.view;
  for (const graph::Finding& finding : graph::check(graph)) {
    number += std::count(text.begin() + at, text.begin() + std::max(at, finding.line), '\n');
    at = std::max(at, finding.line);
    found.push_back({number, finding.error, finding.cause});
  }
  cmd::note(std::to_string(found.size()) + " findings");
  std::stable_sort(found.begin(), found.end(),
                   [](const Message& a, const Message& b) { return a.line < b.line; });
  return found;
}

int check(const cmd::Command& command, const cmd::Inputs& inputs, const std::string& path) {
  cmd::Output output(path);
  bool errors = false;
  for (const auto& file : inputs.paths) {
    const std::string name = text::input_name(file);
    for (const Message& found : messages(file, inputs.options)) {
      errors = errors || found.error;
      if (command.quiet && !found.error) continue;
      const std::string place = found.line ? name + ":" + std::to_string(found.line) : name;
      output.write(place + (found.error ? ": error: " : ": warning: ") + found.cause + "\n");
    }
  }
  output.commit();
  return errors ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  cmd::Command command("sg-check", "Find what is wrong with a graph: a line a finding.");
  cmd::Inputs inputs;
  cmd::OutputOptions output;
  cmd::add_inputs(command, inputs);
  cmd::add_output(command, output);
  return cmd::run_status(command, argc, argv, [&] { return check(command, inputs, output.path); });
}
