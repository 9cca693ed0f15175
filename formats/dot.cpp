#include "formats/dot.h"

#include <array>

#include "lib/graph/replay.h"

namespace sg::formats {
namespace {

std::string node(const Graph& graph, Index v) {
  constexpr std::array<const char*, 3> shapes{"circle", "box", "diamond"};  // by Role
  const std::string shape = shapes[static_cast<std::size_t>(graph.role(v))];
  return "  " + std::to_string(graph.id[v]) + " [shape=" + shape +
         (graph.fixed[v] ? ", style=filled" : "") + "];\n";
}

std::string style(graph::EdgeRole role) {
  if (role == graph::EdgeRole::odometry) return " [style=bold]";
  return role == graph::EdgeRole::loop_closure ? " [style=dashed]" : "";
}

std::string line(const Graph& graph, const graph::PoseIndex& poses, Index e) {
  const auto ends = graph.edge(e);
  if (ends.size() == 2) {
    return "  " + std::to_string(graph.id[ends[0]]) + " -- " + std::to_string(graph.id[ends[1]]) +
           style(graph::edge_role(graph, poses, e)) + ";\n";
  }
  const std::string point = "e" + std::to_string(e);
  std::string text = "  " + point + " [shape=point];\n";
  for (Index v : ends) text += "  " + point + " -- " + std::to_string(graph.id[v]) + ";\n";
  return text;
}

}  // namespace

void write_dot(const Graph& graph, const WriteOptions&, Sink& sink) {
  const graph::PoseIndex poses = graph::pose_index(graph);
  sink.write("graph {\n");
  for (Index v = 0; v < graph.vertices(); ++v) sink.write(node(graph, v));
  for (Index e = 0; e < graph.edges(); ++e) sink.write(line(graph, poses, e));
  sink.write("}\n");
}

}  // namespace sg::formats
