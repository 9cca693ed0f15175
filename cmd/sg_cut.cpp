// sg-cut: keep a part of a graph: steps, poses, ids, or what is connected.
#include <algorithm>

#include "cmd/common/command.h"
#include "cmd/common/options.h"
#include "lib/graph/cut.h"
#include "lib/text/words.h"

namespace {

struct Options {
  sg::Input input;
  sg::OutputOptions output;
  std::optional<sg::Index> poses;
  sg::Index min_obs = 1;
  std::string range;
  std::optional<sg::Id> component;
  bool largest = false;
  std::vector<std::string> ids;
};

// "A" or "A:B"; a usage Error for anything else.
std::pair<sg::Id, sg::Id> parse_range(std::string_view text) {
  const auto colon = text.find(':');
  const auto first = sg::parse<sg::Id>(text.substr(0, colon));
  const auto last = colon == text.npos ? first : sg::parse<sg::Id>(text.substr(colon + 1));
  if (!first || !last || *first < 0 || *last < *first)
    throw sg::usage_error("'" + std::string(text) + "' is no range FIRST:LAST");
  return {*first, *last};
}

sg::Part ranges_of_ids(const sg::Graph& graph, const std::vector<std::string>& ids) {
  std::vector<std::pair<sg::Id, sg::Id>> ranges;
  ranges.reserve(ids.size());
  for (const auto& text : ids) ranges.push_back(parse_range(text));
  return sg::of_ids(graph, ranges);
}

sg::Part range_of_poses(const sg::Graph& graph, const std::string& text) {
  const auto [first, last] = parse_range(text);
  const sg::PoseIndex poses = sg::pose_index(graph);
  const auto count = static_cast<sg::Id>(poses.pose.size());
  if (first >= count)
    throw sg::usage_error("--range begins at pose " + std::to_string(first) + ", but there are " +
                          std::to_string(count));
  return sg::pose_range(graph, poses, static_cast<sg::Index>(first),
                        static_cast<sg::Index>(std::min(last, count - 1)));
}

sg::Part component_of(const sg::Graph& graph, sg::Id id) {
  const auto v = sg::find_vertex(graph, id);
  if (!v) throw sg::usage_error("--component: the graph has no vertex " + std::to_string(id));
  return sg::component_of(graph, *v);
}

sg::Part part(const sg::Graph& graph, const Options& options) {
  if (options.poses)
    return sg::first_steps(graph, sg::pose_index(graph), *options.poses, options.min_obs);
  if (!options.range.empty()) return range_of_poses(graph, options.range);
  if (options.component) return component_of(graph, *options.component);
  if (options.largest) return sg::largest_component(graph);
  return ranges_of_ids(graph, options.ids);
}

void check_call(const Options& options) {
  const int parts = options.poses.has_value() + !options.range.empty() +
                    options.component.has_value() + options.largest + !options.ids.empty();
  if (parts != 1)
    throw sg::usage_error("one of --poses, --range, --component, --largest and --ids is needed");
}

void check_rest(const sg::Graph& graph, const sg::Part& kept) {
  const auto any = [](const std::vector<bool>& of) {
    return std::find(of.begin(), of.end(), true) != of.end();
  };
  if (any(kept.edge) || (any(kept.vertex) && !graph.edges_only)) return;
  throw sg::input_error(graph.file, 0, "the part holds no vertex and no edge");
}

void cut(const sg::Command& command, const Options& options) {
  check_call(options);
  const sg::Graph graph = sg::read(options.input);
  sg::Part kept = part(graph, options);
  check_rest(graph, kept);
  sg::Changes changes = sg::unchanged(graph);
  kept.vertex.flip();
  kept.edge.flip();
  changes.drop_vertex = std::move(kept.vertex);
  changes.drop_edge = std::move(kept.edge);
  sg::write_filtered(command, options.output, graph, std::move(changes));
}

void add_options(sg::Command& command, Options& options) {
  sg::add_input(command, options.input);
  auto& app = command.app;
  app.add_option("--poses", options.poses, "Keep the first N steps of the replay")
      ->check(CLI::PositiveNumber)
      ->option_text("N");
  app.add_option("--range", options.range, "Keep poses FIRST to LAST by index, counted from 0")
      ->option_text("FIRST:LAST");
  app.add_option("--component", options.component, "Keep what is connected to vertex ID")
      ->option_text("ID");
  app.add_flag("--largest", options.largest, "Keep the largest connected part");
  app.add_option("--ids", options.ids, "Keep these vertices and the edges among them")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("ID,FIRST:LAST,...");
  sg::add_entry(app, options.min_obs, "With --poses: a landmark");
  sg::add_filter_output(command, options.output);
}

}  // namespace

int main(int argc, char** argv) {
  return sg::run(sg::Command("sg-cut", "Keep a part of a graph."), argc, argv, add_options, cut);
}
