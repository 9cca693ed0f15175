#include <algorithm>

#include "cmd/common/table.h"
#include "lib/graph/summary.h"

namespace {

using Fact = std::pair<std::string, sg::Cell>;

sg::Cell count(std::int64_t value) {
  return value;
}

// Nothing where there is nothing to average over.
sg::Cell average(std::int64_t sum, std::int64_t count) {
  if (count == 0) return {};
  return static_cast<double>(sum) / static_cast<double>(count);
}

std::vector<Fact> facts(const sg::Graph& graph, std::string_view format) {
  const sg::Summary s = sg::summarize(graph);
  return {
      {"file", graph.file},
      {"format", std::string(format)},
      {"vertices", count(graph.vertices())},
      {"poses", count(s.poses)},
      {"landmarks", count(s.landmarks)},
      {"other_vertices", count(s.others)},
      {"fixed", count(s.fixed)},
      {"isolated", count(s.isolated)},
      {"edges", count(graph.edges())},
      {"odometry", count(s.odometry)},
      {"loop_closures", count(s.loop_closures)},
      {"observations", count(s.observations)},
      {"other_edges", count(s.other_edges)},
      {"segments", count(s.segments)},
      {"components", count(s.components)},
      {"dim", count(s.dim)},
      {"rows", count(s.rows)},
      {"obs_per_landmark", average(s.sights, s.landmarks)},
      {"obs_per_pose", average(s.sights, s.poses)},
      {"edges_per_vertex",
       average(static_cast<std::int64_t>(graph.edge_vertices.size()), graph.vertices())},
      {"max_edges_per_vertex", count(s.max_degree)},
      {"id_min", count(graph.id.front())},
      {"id_max", count(graph.id.back())},
      {"estimates", std::string(graph.edges_only ? "no" : "yes")},
      {"order", graph.order_method.empty() ? sg::Cell{} : sg::Cell{graph.order_method}},
  };
}

// One fact a line; or, as JSON, one object.
void print(const std::vector<Fact>& facts, const sg::TableOptions& options,
           const std::string& path) {
  std::vector<std::string_view> keys;
  std::vector<sg::Cell> values;
  for (const auto& [key, value] : facts) {
    keys.push_back(key);
    values.push_back(value);
  }
  sg::Output output(path);
  if (options.json) {
    sg::Table(options, keys, output).row(values);
    return output.commit();
  }
  const auto chosen = options.columns.empty() ? std::vector<std::string>(keys.begin(), keys.end())
                                              : options.columns;
  sg::Table table({{}, options.header, false}, {"key", "value"}, output);
  for (const auto& key : chosen) {
    const auto at = std::find(keys.begin(), keys.end(), key) - keys.begin();
    if (at == static_cast<std::ptrdiff_t>(keys.size()))
      throw sg::usage_error("no key '" + key + "' in this graph");
    table.row({key, values[at]});
  }
  output.commit();
}

}  // namespace

int main(int argc, char** argv) {
  sg::Command command("sg-info", "Say what is in a graph file.");
  sg::Input input;
  sg::TableOptions options;
  sg::OutputOptions output;
  sg::add_input(command, input);
  sg::add_output(command, output);
  command.app.add_option("-f,--fields", options.columns, "Only these keys, in this order")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("NAME,...");
  command.app.add_flag_callback(
      "--no-header", [&options] { options.header = false; }, "No header line");
  command.app.add_flag("--json", options.json, "One JSON object");
  return sg::run(command, argc, argv, [&] {
    const sg::Text text = sg::read_text(input);
    const sg::Graph graph = sg::read(input, text);
    std::vector<Fact> all = facts(graph, sg::find_format(input.options, text.view).name);
    for (const auto& [tag, lines] : sg::count_tags(text.view)) all.emplace_back(tag, count(lines));
    print(all, options, output.path);
  });
}
