// sg-convert: write a graph in another format.
#include <algorithm>
#include <limits>

#include "cmd/common/command.h"
#include "cmd/common/complete.h"
#include "cmd/common/options.h"
#include "cmd/common/ranges.h"
#include "cmd/convert/hessian.h"
#include "formats/applied.h"
#include "formats/convert.h"
#include "formats/renumber.h"
#include "formats/scale.h"
#include "formats/times_file.h"
#include "formats/tum.h"
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
  bool values = false;
  std::string times;
  std::vector<std::string> scale_information;
  std::vector<Id> fix;
  bool renumber = false;
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

// FIX lines at the end for the vertices that have none.
formats::Changes with_fixed(const Graph& graph, const std::vector<Id>& ids) {
  formats::Changes changes = formats::unchanged(graph);
  std::vector<bool> fixed = graph.fixed;
  for (const Id id : ids) {
    const Index v = cmd::vertex_of(graph, "--fix", id);
    if (!fixed[v]) changes.append += std::string(graph::fix_tag) + " " + std::to_string(id) + "\n";
    fixed[v] = true;
  }
  return changes;
}

formats::Changes scaled(const Graph& graph, const std::vector<std::string>& texts) {
  std::vector<formats::InformationScale> scales;
  scales.reserve(texts.size());
  for (const auto& text : texts) scales.push_back(formats::parse_scale(graph.tags, text));
  return formats::scaled(graph, scales);
}

// The graph with what the call changes of it; ids in the call are those of the file.
Graph edited(const Options& options, Graph graph) {
  const auto apply = [&](formats::Changes changes) {
    graph = formats::applied(graph, std::move(changes), options.input.options);
  };
  if (!graph.left_out.empty()) apply(formats::unchanged(graph));
  if (!options.scale_information.empty()) apply(scaled(graph, options.scale_information));
  if (!options.fix.empty()) apply(with_fixed(graph, options.fix));
  if (options.renumber) apply(formats::renumbered(graph, formats::counted_ids(graph)));
  return graph;
}

// Of every pose that a trajectory can have; nothing without --times.
std::vector<std::string> times(const Options& options, const Graph& graph) {
  if (options.times.empty()) return {};
  const std::string file = text::input_name(options.times);
  std::vector<std::string> times =
      formats::parse_times(text::read_text(options.times).view, file, graph);
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (times[v].empty() && formats::is_trajectory_pose(graph, v))
      throw text::input_error(file, 0, "it has no time of vertex " + std::to_string(graph.id[v]));
  }
  return times;
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

void run(const cmd::Command& command, const Options& given) {
  const Options options = with_format(command, given);
  const formats::WriteFormat& format = formats::find_write_format(options.to);
  if (options.to != "mtx") cmd::refuse(command.app, {"--scalar", "--values"}, "without --to mtx");
  if (options.values) cmd::refuse(command.app, {"--scalar"}, "with --values, which are scalars");
  if (options.to != "tum") cmd::refuse(command.app, {"--times"}, "without --to tum");
  if (options.renumber) cmd::refuse(command.app, {"--times"}, "with --renumber, which changes ids");
  check_ending(options);
  Graph graph = cmd::read(options.input);
  cmd::stage("convert");
  const bool edits = options.renumber || !options.fix.empty() || !options.scale_information.empty();
  if (edits) graph = edited(options, std::move(graph));
  const std::vector<std::string> lost = losses(options, graph);
  if (graph.edges_only && (options.estimates || format.estimates))
    graph = with_estimates(command, graph, options.input.options);
  formats::WriteOptions write = options.write;
  write.times = times(options, graph);
  cmd::Output output(options.output.path);
  if (options.values) {
    convert::write_hessian(graph, output);
  } else {
    format.write(graph, write, output);
  }
  output.commit();
  for (const std::string& line : lost) cmd::warn(command, line);
}

void add_options(cmd::Command& command, Options& options) {
  cmd::add_input(command, options.input);
  command.app
      .add_option("--to", options.to,
                  text::listed(text::names_of(formats::write_formats())) + "\n(default: g2o)")
      ->check(cmd::suggests(text::names_of(formats::write_formats())))
      ->option_text("FORMAT");
  command.app.add_flag("--scalar", options.write.scalar,
                       "mtx: the scalar system matrix, not the block one");
  command.app.add_flag("--values", options.values, "mtx: the scalar one with its numbers");
  command.app.add_option("--times", options.times, "tum: the times of a table of id and time")
      ->option_text("FILE");
  command.app.add_flag("--renumber", options.renumber,
                       "Poses 0, 1, 2, ..., all others behind them");
  command.app
      .add_option("--scale-information", options.scale_information,
                  "Multiply the information of edges of this tag by X")
      ->option_text("TAG=X")
      ->allow_extra_args(false);
  command.app.add_option("--fix", options.fix, "Make these vertices constants")
      ->transform(cmd::whole(0, std::numeric_limits<Id>::max()))
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("ID,...");
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
                  add_options, run);
}
