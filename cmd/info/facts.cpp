#include "cmd/info/facts.h"

namespace sg::info {
namespace {

template <class Number>
cmd::Column<Row> count(std::string name, std::string what, Number graph::Summary::*number) {
  return {std::move(name), std::move(what), [number](Row& row) { return row.summary.*number; }};
}

// Nothing where there is nothing to average over.
std::optional<double> average(std::int64_t sum, std::int64_t count) {
  if (count == 0) return std::nullopt;
  return static_cast<double>(sum) / static_cast<double>(count);
}

}  // namespace

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

}  // namespace sg::info
