// sg-convert: write a graph in another format.
#include <algorithm>

#include "cmd/common/command.h"
#include "formats/convert.h"
#include "lib/factor/initialize.h"
#include "lib/solve/undetermined.h"

namespace {

struct Options {
  sg::Input input;
  sg::OutputOptions output;
  std::string to = "g2o";
  sg::WriteOptions write;
  bool estimates = false;
  bool lossy = false;
};

// The graph with a VERTEX line for every vertex, its estimate composed from the edges.
sg::Graph with_estimates(const sg::Command& command, const sg::Graph& graph,
                         sg::ReadOptions options) {
  const sg::Problem problem = sg::make_problem(graph);
  const sg::Composed start = sg::compose(problem);
  if (!start.adrift.empty()) {
    std::vector<sg::Id> ids;
    for (sg::Index v : start.adrift) ids.push_back(graph.id[v]);
    std::ranges::sort(ids);
    sg::warn(
        command,
        graph.file + ": no edge places " + sg::id_ranges(ids) +
            " beside the poses before: at the origin (sg-solve moves them to where they belong)");
  }
  std::string text;
  for (sg::Index v = 0; v < graph.vertices(); ++v) {
    text += sg::vertex_line(problem, start.values, v);
  }
  text += graph.text.view;
  options.format = "g2o";
  return sg::read_graph_text(sg::text_of(std::move(text)), graph.file, options);
}

// One line of what the format cannot hold: an error where a part of the graph would be missing.
void report_losses(const sg::Command& command, const Options& options, const sg::Graph& graph) {
  for (const sg::Loss& loss : sg::find_write_format(options.to).losses(graph)) {
    const bool error = loss.structure && !options.lossy;
    std::string cause = options.to + " cannot hold " + loss.what + " (" +
                        std::to_string(loss.count) + (loss.count == 1 ? " line" : " lines");
    cause += error ? "; --lossy leaves them out)" : ", left out)";
    const sg::Error at_line = sg::error_at(graph, loss.first, cause);
    if (error) throw at_line;
    sg::warn(command, sg::message(at_line));
  }
}

void convert(const sg::Command& command, const Options& options) {
  const sg::WriteFormat& format = sg::find_write_format(options.to);
  if (options.write.scalar && options.to != "mtx")
    throw sg::usage_error("--scalar belongs to --to mtx");
  sg::Graph graph = sg::read(options.input);
  report_losses(command, options, graph);
  if (graph.edges_only && (options.estimates || options.to == "tum"))
    graph = with_estimates(command, graph, options.input.options);
  sg::Output output(options.output.path);
  format.write(graph, options.write, output);
  output.commit();
}

std::string known_formats() {
  std::string known;
  for (const sg::WriteFormat& format : sg::write_formats())
    known += (known.empty() ? "" : ", ") + std::string(format.name);
  return known;
}

void add_options(sg::Command& command, Options& options) {
  sg::add_input(command, options.input);
  command.app.add_option("--to", options.to, known_formats() + " (default: g2o)")
      ->option_text("FORMAT");
  command.app.add_flag("--scalar", options.write.scalar,
                       "mtx: the scalar system matrix, not the block one");
  command.app.add_flag("--estimates", options.estimates,
                       "In an edges-only file: add VERTEX lines,\ncomposed along odometry");
  command.app.add_flag("--lossy", options.lossy, "Leave out what the format cannot hold");
  sg::add_output(command, options.output);
}

}  // namespace

int main(int argc, char** argv) {
  return sg::run(sg::Command("sg-convert", "Write a graph in another format."), argc, argv,
                 add_options, convert);
}
