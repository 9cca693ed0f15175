// sg-info: what is in a graph file, a fact a line.
#include "cmd/common/table.h"
#include "lib/graph/summary.h"

namespace {

struct Row {
  const sg::Graph& graph;
  std::string_view format;
  sg::Summary summary;
};

template <class Number>
sg::Column<Row> count(std::string name, std::string what, Number sg::Summary::*number) {
  return {std::move(name), std::move(what), [number](Row& row) { return row.summary.*number; }};
}

// Nothing where there is nothing to average over.
std::optional<double> average(std::int64_t sum, std::int64_t count) {
  if (count == 0) return std::nullopt;
  return static_cast<double>(sum) / static_cast<double>(count);
}

// The facts of every graph. Those of a file's tags follow them.
const std::vector<sg::Column<Row>> facts{
    {"file", "The name as given", [](Row& row) { return row.graph.file; }},
    {"format", "g2o, toro or isam", [](Row& row) { return row.format; }},
    {"vertices", "All of them", [](Row& row) { return row.graph.vertices(); }},
    count("poses", "Vertices that are poses", &sg::Summary::poses),
    count("landmarks", "Vertices that are landmarks", &sg::Summary::landmarks),
    count("other_vertices", "Vertices that are neither", &sg::Summary::others),
    count("fixed", "Vertices of FIX lines", &sg::Summary::fixed),
    count("isolated", "Vertices without an edge", &sg::Summary::isolated),
    {"edges", "All of them", [](Row& row) { return row.graph.edges(); }},
    count("odometry", "Edges between consecutive poses", &sg::Summary::odometry),
    count("loop_closures", "Edges between any other poses", &sg::Summary::loop_closures),
    count("observations", "Edges between poses and landmarks", &sg::Summary::observations),
    count("other_edges", "Edges of any other kind", &sg::Summary::other_edges),
    count("segments", "Of the trajectory: odometry leads on within one", &sg::Summary::segments),
    count("components", "Connected parts", &sg::Summary::components),
    count("dim", "Columns of the scalar system: tangent dimensions", &sg::Summary::dim),
    count("rows", "Rows of the scalar system: dimensions of measurements", &sg::Summary::rows),
    {"obs_per_landmark", "Average number of observations",
     [](Row& row) { return average(row.summary.sights, row.summary.landmarks); }},
    {"obs_per_pose", "Average number of observations",
     [](Row& row) { return average(row.summary.sights, row.summary.poses); }},
    {"edges_per_vertex", "Average number of edges at a vertex",
     [](Row& row) {
       return average(static_cast<std::int64_t>(row.graph.edge_vertices.size()),
                      row.graph.vertices());
     }},
    count("max_edges_per_vertex", "Largest number of edges at a vertex", &sg::Summary::max_degree),
    {"id_min", "The smallest id", [](Row& row) { return row.graph.id.front(); }},
    {"id_max", "The largest id", [](Row& row) { return row.graph.id.back(); }},
    {"estimates", "Whether the file has VERTEX lines",
     [](Row& row) { return row.graph.edges_only ? "no" : "yes"; }},
    {"order", "Method by which sg-order ordered the file, if it did",
     [](Row& row) -> sg::Cell {
       if (row.graph.order_method.empty()) return {};
       return row.graph.order_method;
     }},
};

std::vector<sg::Column<Row>> with_tags(std::vector<sg::Column<Row>> columns,
                                       std::string_view text) {
  for (const auto& [tag, lines] : sg::count_tags(text))
    columns.push_back({tag, "Lines with this tag", [n = lines](Row&) { return n; }});
  return columns;
}

using Fact = std::pair<std::string, sg::Cell>;
const std::vector<sg::Column<Fact>> lines{{"key", "A fact's name", &Fact::first},
                                          {"value", "What it is", &Fact::second}};

struct Options {
  sg::Input input;
  sg::OutputOptions output;
  sg::TableOptions table;
};

void add_options(sg::Command& command, Options& options) {
  sg::add_input(command, options.input);
  sg::add_output(command, options.output);
  sg::add_table(command, options.table, facts);
}

void show(const sg::Command& /*command*/, const Options& options) {
  const sg::Text text = sg::read_text(options.input);
  const sg::Graph graph = sg::read(options.input, text);
  const auto columns = with_tags(facts, text.view);
  Row row{graph, sg::find_format(options.input.options, text.view).name, sg::summarize(graph)};
  sg::Output output(options.output.path);
  if (options.table.json) {
    sg::Table(options.table, columns, {}, output).row(row);
    return output.commit();
  }
  const auto chosen = sg::chosen_columns(options.table, sg::headings(columns), {});
  sg::Table table({{}, options.table.header, false}, lines, {}, output);
  for (const std::size_t k : chosen) table.row({columns[k].name, columns[k].cell(row)});
  output.commit();
}

}  // namespace

int main(int argc, char** argv) {
  return sg::run(sg::Command("sg-info", "Say what is in a graph file."), argc, argv, add_options,
                 show);
}
