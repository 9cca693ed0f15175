// sg-convert: write a graph in another format.
#include <algorithm>

#include "cmd/common/command.h"
#include "formats/convert.h"
#include "lib/factor/initialize.h"
#include "lib/solve/undetermined.h"
#include "lib/text/nearest.h"

using namespace sg;

namespace {

struct Options {
  cmd::Input input;
  cmd::OutputOptions output;
  std::string to = "g2o";
  formats::WriteOptions write;
  bool estimates = false;
  bool lossy = false;
};

// The graph with a VERTEX line for every vertex, its estimate composed from the edges.
Graph with_estimates(const cmd::Command& command, const Graph& graph,
                     formats::ReadOptions options) {
  const factor::Problem problem = factor::make_problem(graph);
  const factor::Composed start = factor::compose(problem);
  if (!start.adrift.empty()) {
    std::vector<Id> ids;
    for (Index v : start.adrift) ids.push_back(graph.id[v]);
    std::ranges::sort(ids);
    cmd::warn(
        command,
        graph.file + ": no edge places " + solve::id_ranges(ids) +
            " beside the poses before: at the origin (sg-solve moves them to where they belong)");
  }
  std::string text;
  for (Index v = 0; v < graph.vertices(); ++v) {
    text += factor::vertex_line(problem, start.values, v);
  }
  text += graph.text.view;
  options.format = "g2o";
  return formats::read_graph_text(text::text_of(std::move(text)), graph.file, options);
}

// What the format cannot hold, a line each: thrown where a part of the graph would be missing.
std::vector<std::string> losses(const Options& options, const Graph& graph) {
  std::vector<std::string> said;
  for (const formats::Loss& loss : formats::find_write_format(options.to).losses(graph)) {
    const bool error = loss.structure && !options.lossy;
    std::string cause = options.to + " cannot hold " + loss.what + " (" +
                        std::to_string(loss.count) + (loss.count == 1 ? " line" : " lines");
    cause += error ? "; --lossy leaves them out)" : ", left out)";
    const text::Error at_line = graph::error_at(graph, loss.first, cause);
    if (error) throw at_line;
    said.push_back(text::message(at_line));
  }
  return said;
}

// A name that promises another format.
void check_ending(const Options& options) {
  const std::string& path = options.output.path;
  for (const formats::WriteFormat& other : formats::write_formats()) {
    if (other.name != options.to && path.ends_with("." + std::string(other.name)))
      throw text::usage_error("-o " + path + ": what is written is " + options.to + "; --to " +
                              std::string(other.name) + " writes the other");
  }
  if (const std::string cause = cmd::packed_ending(path); !cause.empty())
    throw text::usage_error("-o " + cause);
}

// Without --to, the format that -o's name ends in, if any does.
Options with_format(const cmd::Command& command, Options options) {
  if (cmd::given(command.app, "--to")) return options;
  for (const formats::WriteFormat& format : formats::write_formats()) {
    if (options.output.path.ends_with("." + std::string(format.name))) options.to = format.name;
  }
  return options;
}

void convert(const cmd::Command& command, const Options& given) {
  const Options options = with_format(command, given);
  const formats::WriteFormat& format = formats::find_write_format(options.to);
  if (options.to != "mtx") cmd::refuse(command.app, {"--scalar"}, "without --to mtx");
  check_ending(options);
  Graph graph = cmd::read(options.input);
  cmd::stage("convert");
  const std::vector<std::string> lost = losses(options, graph);
  if (graph.edges_only && (options.estimates || format.estimates))
    graph = with_estimates(command, graph, options.input.options);
  cmd::Output output(options.output.path);
  format.write(graph, options.write, output);
  output.commit();
  for (const std::string& line : lost) cmd::warn(command, line);
}

void add_options(cmd::Command& command, Options& options) {
  cmd::add_input(command, options.input);
  command.app
      .add_option("--to", options.to,
                  text::listed(text::names_of(formats::write_formats())) + "\n(default: g2o)")
      ->option_text("FORMAT");
  command.app.add_flag("--scalar", options.write.scalar,
                       "mtx: the scalar system matrix, not the block one");
  command.app.add_flag("--estimates", options.estimates,
                       "In an edges-only file: add VERTEX lines,\ncomposed along odometry");
  command.app.add_flag("--lossy", options.lossy, "Leave out what the format cannot hold");
  cmd::add_output(
      command.app, options.output,
      "Write to FILE, whole or not at all; without --to\nin the format that its name ends in",
      cmd::Writes::other);
}

}  // namespace

int main(int argc, char** argv) {
  return cmd::run(cmd::Command("sg-convert", "Write a graph in another format."), argc, argv,
                  add_options, convert);
}
