// sg-merge: several graphs as one: of several robots, of several sessions.
#include <limits>

#include "cmd/common/command.h"
#include "cmd/common/options.h"
#include "cmd/common/ranges.h"
#include "formats/applied.h"
#include "formats/merge.h"

using namespace sg;

namespace {

struct Options {
  cmd::Inputs inputs;
  cmd::OutputOptions output;
  std::string ids = "offset";
  std::vector<std::string> shared;
};

formats::MergeOptions merge_options(const cmd::Command& command, const Options& options) {
  formats::MergeOptions merge;
  merge.ids = options.ids == "prefix" ? formats::MergedIds::prefix
              : options.ids == "keep" ? formats::MergedIds::keep
                                      : formats::MergedIds::offset;
  if (options.shared == std::vector<std::string>{"all"}) {
    cmd::refuse(command.app, {"--ids"}, "with --shared all, where every id stays");
    merge.ids = formats::MergedIds::keep;
    merge.shared = {{0, std::numeric_limits<Id>::max()}};
  } else {
    merge.shared = cmd::parse_ranges("--shared", options.shared);
  }
  return merge;
}

// Without the lines that reading left out: its changes may name every line.
Graph read_kept(const cmd::Inputs& inputs, const std::string& path) {
  const Graph graph = cmd::read(inputs, path);
  if (graph.left_out.empty()) return graph;
  return formats::applied(graph, formats::unchanged(graph), inputs.options);
}

void merge(const cmd::Command& command, const Options& options) {
  const formats::MergeOptions how = merge_options(command, options);
  std::vector<Graph> graphs;
  for (const auto& path : options.inputs.paths) graphs.push_back(read_kept(options.inputs, path));
  cmd::stage("merge");
  auto changes = formats::merged(graphs, how, command.name);
  cmd::stage("write");
  cmd::Output output(options.output.path);
  formats::write_merged(graphs, std::move(changes), cmd::trace_comment(command, options.output),
                        output);
  output.commit();
}

void add_options(cmd::Command& command, Options& options) {
  cmd::add_inputs(command, options.inputs);
  command.app
      .add_option(
          "--ids", options.ids,
          "offset (default): behind those of the graphs\nbefore; prefix: 1, 2, ... in front; "
          "keep")
      ->option_text("HOW")
      ->check(cmd::one_of({"offset", "prefix", "keep"}));
  command.app
      .add_option("--shared", options.shared,
                  "Ids that name one vertex in all graphs, and stay;\nall: every id")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("ID,FIRST:LAST,...|all");
  cmd::add_filter_output(command, options.output);
}

}  // namespace

int main(int argc, char** argv) {
  return cmd::run(cmd::Command("sg-merge", "Several graphs as one."), argc, argv, add_options,
                  merge);
}
