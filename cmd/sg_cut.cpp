// sg-cut: keep a part of a graph: steps, poses, ids, tags, what is connected, or edges by what is true of them.
#include <algorithm>

#include "cmd/common/command.h"
#include "cmd/common/options.h"
#include "cmd/common/ranges.h"
#include "cmd/cut/where.h"
#include "lib/graph/cut.h"
#include "lib/text/nearest.h"

using namespace sg;

namespace {

struct Options {
  cmd::Input input;
  cmd::OutputOptions output;
  std::optional<Index> poses;
  Index min_obs = 1;
  std::string range;
  std::optional<Id> component;
  bool largest = false;
  std::vector<std::string> ids;
  std::vector<std::string> tags, without;
  std::string where;
};

graph::Part range_of_poses(const Graph& graph, const std::string& text) {
  const auto [first, last] = cmd::parse_range("--range", text);
  const graph::PoseIndex poses = graph::pose_index(graph);
  const auto count = static_cast<Id>(poses.pose.size());
  if (first >= count)
    throw text::usage_error("--range begins at pose " + std::to_string(first) + ", but there are " +
                            std::to_string(count));
  return graph::pose_range(graph, poses, static_cast<Index>(first),
                           static_cast<Index>(std::min(last, count - 1)));
}

graph::Part component_of(const Graph& graph, Id id) {
  return graph::component_of(graph, cmd::vertex_of(graph, "--component", id));
}

// The types that these tags mean.
graph::Types types_of(const Graph& graph, const std::string& option,
                      const std::vector<std::string>& tags) {
  graph::Types types{std::vector<bool>(graph.tags.vertices.size(), false),
                     std::vector<bool>(graph.tags.edges.size(), false)};
  for (const auto& tag : tags) {
    const graph::TagMeaning* const meaning = graph.tags.find(tag);
    if (meaning && meaning->kind == graph::LineKind::vertex) {
      types.vertex[meaning->type] = true;
    } else if (meaning && meaning->kind == graph::LineKind::edge) {
      types.edge[meaning->type] = true;
    } else {
      std::vector<std::string> known;
      for (const auto& [name, count] : formats::count_tags(graph.text.view)) {
        const graph::TagMeaning* const other = graph.tags.find(name);
        if (other &&
            (other->kind == graph::LineKind::vertex || other->kind == graph::LineKind::edge))
          known.push_back(name);
      }
      std::string cause = option;
      cause.append(" ").append(tag).append(": no vertex or edge has this tag; ");
      throw text::usage_error(cause + text::suggestion(tag, known));
    }
  }
  return types;
}

graph::Part part(const Graph& graph, const Options& options) {
  if (options.poses)
    return graph::first_steps(graph, graph::pose_index(graph), *options.poses, options.min_obs);
  if (!options.range.empty()) return range_of_poses(graph, options.range);
  if (options.component) return component_of(graph, *options.component);
  if (options.largest) return graph::largest_component(graph);
  if (!options.tags.empty()) return graph::of_types(graph, types_of(graph, "--tags", options.tags));
  if (!options.without.empty())
    return graph::without_types(graph, types_of(graph, "--without", options.without));
  if (!options.where.empty())
    return {std::vector<bool>(graph.vertices(), true),
            cut::edges_where(graph, cut::parse_condition(options.where))};
  return graph::of_ids(graph, cmd::ranges_of_vertices(graph, "--ids", options.ids));
}

void check_call(const cmd::Command& command, const Options& options) {
  cmd::exactly_one(command.app,
                   {{"--poses", "keeps the first steps"},
                    {"--range", "poses by index"},
                    {"--component", "what is connected to a vertex"},
                    {"--largest", "the largest connected part"},
                    {"--ids", "vertices by id"},
                    {"--tags", "lines by tag"},
                    {"--without", "lines of other tags"},
                    {"--where", "edges by what is true of them"}},
                   "which part?");
  if (!options.poses) cmd::refuse(command.app, {"--min-obs"}, "without --poses");
  if (!options.range.empty()) cmd::parse_range("--range", options.range);
  if (!options.where.empty()) cut::parse_condition(options.where);
  cmd::parse_ranges("--ids", options.ids);
}

void check_rest(const Graph& graph, const graph::Part& kept) {
  const auto any = [](const std::vector<bool>& of) {
    return std::find(of.begin(), of.end(), true) != of.end();
  };
  if (any(kept.edge) || (any(kept.vertex) && !graph.edges_only)) return;
  throw text::input_error(graph.file, 0, "the part holds no vertex and no edge");
}

void cut_out(const cmd::Command& command, const Options& options) {
  check_call(command, options);
  const Graph graph = cmd::read(options.input);
  cmd::stage("cut");
  graph::Part kept = part(graph, options);
  check_rest(graph, kept);
  formats::Changes changes = formats::unchanged(graph);
  const auto counted = [](const std::vector<bool>& of) {
    return std::to_string(std::count(of.begin(), of.end(), true)) + " of " +
           std::to_string(of.size());
  };
  cmd::note("kept " + counted(kept.vertex) + " vertices, " + counted(kept.edge) + " edges");
  kept.vertex.flip();
  kept.edge.flip();
  changes.drop_vertex = std::move(kept.vertex);
  changes.drop_edge = std::move(kept.edge);
  cmd::write_filtered(command, options.output, graph, std::move(changes));
}

void add_options(cmd::Command& command, Options& options) {
  cmd::add_input(command, options.input);
  auto& app = command.app;
  app.add_option("--poses", options.poses, "Keep the first N steps of the replay")
      ->transform(cmd::whole(1))
      ->option_text("N");
  app.add_option("--range", options.range, "Keep poses FIRST to LAST by index, counted from 0")
      ->option_text("FIRST:LAST");
  app.add_option("--component", options.component, "Keep what is connected to vertex ID")
      ->transform(cmd::whole(0, std::numeric_limits<Id>::max()))
      ->option_text("ID");
  app.add_flag("--largest", options.largest, "Keep the largest connected part");
  app.add_option("--ids", options.ids, "Keep these vertices and the edges among them")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("ID,FIRST:LAST,...");
  app.add_option("--tags", options.tags,
                 "Keep vertices of these tags and the edges among\nthem, edges and what they join")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("TAG,...");
  app.add_option("--without", options.without,
                 "Leave these out, and what is no pose and joined by\nno edge any more")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("TAG,...");
  app.add_option("--where", options.where,
                 "Keep all vertices, and the edges of which CONDITION\nholds: columns " +
                     cut::where_columns())
      ->option_text("CONDITION");
  cmd::add_entry(app, options.min_obs, "With --poses: a landmark");
  cmd::add_filter_output(command, options.output);
}

}  // namespace

int main(int argc, char** argv) {
  return cmd::run(cmd::Command("sg-cut", "Keep a part of a graph."), argc, argv, add_options,
                  cut_out);
}
