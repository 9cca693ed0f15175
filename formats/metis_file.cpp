#include "formats/metis_file.h"

#include "lib/graph/pattern.h"

namespace sg::formats {

void write_metis(const Graph& graph, const WriteOptions&, Sink& sink) {
  const graph::Pattern pattern = graph::graph_pattern(graph).pattern;
  const graph::Adjacency neighbours = graph::adjacency(pattern);
  sink.write("% vertices, edges; format 010: a line holds its vertex's weight and neighbours\n");
  sink.write(std::to_string(neighbours.size()) + " " + std::to_string(neighbours.items.size() / 2) +
             " 010 1\n");
  for (Index j = 0; j < neighbours.size(); ++j) {
    std::string line = std::to_string(pattern.dim[j]);
    for (Index i : neighbours[j]) line += " " + std::to_string(i + 1);
    sink.write(line + "\n");
  }
}

}  // namespace sg::formats
