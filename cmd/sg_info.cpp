// sg-info: what is in a graph file, a fact a line.
#include <algorithm>
#include <map>

#include "cmd/common/table.h"
#include "lib/graph/summary.h"

using namespace sg;

namespace {

struct Row {
  const Graph& graph;
  std::string_view format;
  graph::Summary summary;
  std::map<std::string, std::int64_t> tags;  // lines of each
};

template <class Number>
cmd::Column<Row> count(std::string name, std::string what, Number graph::Summary::*number) {
  return {std::move(name), std::move(what), [number](Row& row) { return row.summary.*number; }};
}

// Nothing where there is nothing to average over.
std::optional<double> average(std::int64_t sum, std::int64_t count) {
  if (count == 0) return std::nullopt;
  return static_cast<double>(sum) / static_cast<double>(count);
}

// The facts of every graph. Those of a file's tags follow them.
const std::vector<cmd::Column<Row>> facts{
    {"file", "The name as given", [](Row& row) { return row.graph.file; }},
    {"format", "g2o, toro, isam, tum, kitti or bal", [](Row& row) { return row.format; }},
    {"vertices", "All of them", [](Row& row) { return row.graph.vertices(); }},
    count("poses", "Vertices that are poses", &graph::Summary::poses),
    count("landmarks", "Vertices that are landmarks", &graph::Summary::landmarks),
    count("other_vertices", "Vertices that are neither", &graph::Summary::others),
    count("fixed", "Vertices of FIX lines", &graph::Summary::fixed),
    count("isolated", "Vertices without an edge", &graph::Summary::isolated),
    {"edges", "All of them", [](Row& row) { return row.graph.edges(); }},
    count("odometry", "Edges between consecutive poses", &graph::Summary::odometry),
    count("loop_closures", "Edges between any other poses", &graph::Summary::loop_closures),
    count("observations", "Edges between poses and landmarks", &graph::Summary::observations),
    count("other_edges", "Edges of any other kind", &graph::Summary::other_edges),
    count("segments", "Of the trajectory: odometry leads on within one", &graph::Summary::segments),
    count("components", "Connected parts", &graph::Summary::components),
    count("dim", "Columns of the scalar system: tangent dimensions", &graph::Summary::dim),
    count("rows", "Rows of the scalar system: dimensions of measurements", &graph::Summary::rows),
    {"obs_per_landmark", "Average number of observations",
     [](Row& row) { return average(row.summary.sights, row.summary.landmarks); }},
    {"obs_per_pose", "Average number of observations",
     [](Row& row) { return average(row.summary.sights, row.summary.poses); }},
    {"edges_per_vertex", "Average number of edges at a vertex",
     [](Row& row) {
       return average(static_cast<std::int64_t>(row.graph.edge_vertices.items.size()),
                      row.graph.vertices());
     }},
    count("max_edges_per_vertex", "Largest number of edges at a vertex",
          &graph::Summary::max_degree),
    {"id_min", "The smallest id", [](Row& row) { return row.graph.id.front(); }},
    {"id_max", "The largest id", [](Row& row) { return row.graph.id.back(); }},
    {"estimates", "Whether the file has VERTEX lines",
     [](Row& row) { return !row.graph.edges_only; }},
    {"order", "Method by which sg-order ordered the file, if it did",
     [](Row& row) -> cmd::Cell {
       if (row.graph.order_method.empty()) return {};
       return row.graph.order_method;
     }},
};

struct Options {
  cmd::Inputs inputs;
  cmd::OutputOptions output;
  cmd::TableOptions table;
};

// Whether a file may have lines of this tag: of one of ours, or of one that the call teaches.
bool may_have(const formats::ReadOptions& options, const std::string& tag) {
  const auto of = [&](const auto& row) { return row.tag == tag; };
  const auto taught = [&](const std::vector<std::string>& specs) {
    return std::ranges::any_of(
        specs, [&](const auto& spec) { return spec.substr(0, spec.find_first_of(":=")) == tag; });
  };
  return tag == "#" || tag == graph::fix_tag || std::ranges::any_of(graph::vertex_rows, of) ||
         std::ranges::any_of(graph::edge_rows, of) || std::ranges::any_of(graph::param_rows, of) ||
         std::ranges::any_of(graph::aliases, of) ||
         std::ranges::find(graph::data_tags, tag) != graph::data_tags.end() ||
         taught(options.vertex_types) || taught(options.edge_types) || taught(options.param_tags) ||
         taught(options.aliases);
}

// The facts, and behind them those of tags: of all that are `found` in a file, and of what -f asks for and it lacks.
std::vector<cmd::Column<Row>> with_tags(const Options& options,
                                        const std::vector<std::string>& found) {
  std::vector<cmd::Column<Row>> columns = facts;
  const auto add = [&](const std::string& tag) {
    const bool there = std::ranges::find(columns, tag, &cmd::Column<Row>::name) != columns.end();
    if (!there)
      columns.push_back({tag, "Lines with this tag", [tag](Row& row) { return row.tags[tag]; }});
  };
  for (const std::string& tag : found) add(tag);
  for (const std::string& name : options.table.columns) {
    if (may_have(options.inputs.options, name)) add(name);
  }
  return columns;
}

using Fact = std::pair<std::string, cmd::Cell>;
const std::vector<cmd::Column<Fact>> lines{{"key", "A fact's name", &Fact::first},
                                           {"value", "What it is", &Fact::second}};

void add_options(cmd::Command& command, Options& options) {
  cmd::add_inputs(command, options.inputs);
  cmd::add_output(command, options.output);
  cmd::add_table(command, options.table, facts);
}

// Of one file a line a fact, of several a row each; as JSON an object each.
void show(const cmd::Command& command, const Options& options) {
  cmd::check_form(command.app);
  cmd::Output output(options.output.path);
  cmd::TableOptions form = options.table;
  form.columns.clear();
  std::optional<cmd::Table<Row>> rows;
  std::optional<cmd::Table<Fact>> list;
  if (options.inputs.paths.size() > 1 && !form.json)
    rows.emplace(options.table, with_tags(options, {}), cmd::Given{}, output);
  if (options.inputs.paths.size() == 1 && !form.json)
    list.emplace(form, lines, cmd::Given{}, output);
  for (const std::string& path : options.inputs.paths) {
    const cmd::Input input{path, options.inputs.options};
    const text::Text text = cmd::read_text(input);
    const Graph graph = cmd::read(input, text);
    cmd::stage("count");
    const formats::ReadFormat& format = formats::find_format(input.options, text.view);
    // A format whose lines begin with numbers has no tags but those of what it is read as.
    const bool tagless = format.to_g2o && format.begins("0");
    Row row{graph, format.name, graph::summarize(graph), {}};
    std::vector<std::string> tags;
    for (const auto& [tag, count] : formats::count_tags(tagless ? graph.text.view : text.view)) {
      tags.push_back(tag);
      row.tags[tag] = count;
    }
    const auto columns = with_tags(options, tags);
    if (rows) {
      rows->row(std::move(row));
    } else if (list) {
      for (const std::size_t k : cmd::chosen_columns(options.table, cmd::headings(columns), {}))
        list->row({columns[k].name, columns[k].cell(row)});
    } else {
      cmd::Table(options.table, columns, {}, output).row(std::move(row));
    }
  }
  output.commit();
}

}  // namespace

int main(int argc, char** argv) {
  return cmd::run(cmd::Command("sg-info", "Say what is in a graph file."), argc, argv, add_options,
                  show);
}
