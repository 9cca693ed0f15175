#include "lib/graph/components.h"

#include <catch2/catch.hpp>

#include "formats/formats.h"
#include "lib/graph/cut.h"
#include "tests/unit/common.h"

using namespace sg;
using namespace sg::test;

namespace {

// Poses with ids 0..n-1, landmarks after them, and random edges of one to four ends.
Graph random_graph(Random& random) {
  const auto id = [&](int low, int high) { return std::to_string(draw(random, low, high)); };
  const int poses = draw(random, 1, 8);
  const int landmarks = draw(random, 1, 4);
  const int last = poses + landmarks - 1;
  std::string text;
  for (int k = 0; k < poses; ++k) text += "VERTEX_SE2 " + std::to_string(k) + " 0 0 0\n";
  for (int k = poses; k <= last; ++k) text += "VERTEX_XY " + std::to_string(k) + " 0 0\n";
  for (int e = draw(random, 0, 7); e > 0; --e) {
    text += "EDGE_SE2_LOTSOFXY " + id(0, poses - 1);
    const int points = draw(random, 0, 3);
    text += " " + std::to_string(points);
    for (int k = 0; k < points; ++k) text += " " + id(poses, last);
    for (int k = 0; k < points; ++k) text += " 0 0";
    text += "\nEDGE_SE2 " + id(0, poses - 1) + " " + id(0, poses - 1) + " 0 0 0 1 0 0 1 0 1\n";
  }
  return graph_of(text);
}

// The definition: everything that can be reached along edges.
std::vector<bool> reachable(const Graph& graph, Index from) {
  std::vector<bool> reached(graph.vertices(), false);
  reached[from] = true;
  for (Index round = 0; round < graph.vertices(); ++round) {
    for (Index e = 0; e < graph.edges(); ++e) {
      bool touched = false;
      for (Index v : graph.edge(e)) touched = touched || reached[v];
      for (Index v : graph.edge(e)) reached[v] = reached[v] || touched;
    }
  }
  return reached;
}

}  // namespace

TEST_CASE("components are what edges reach", "[components]") {
  Random random(5);
  for (int trial = 0; trial < 200; ++trial) {
    const Graph graph = random_graph(random);
    const graph::Components parts = graph::components(graph);
    const std::vector<Index> size = graph::sizes(parts);
    Index largest = 0;
    for (Index v = 0; v < graph.vertices(); ++v) {
      const std::vector<bool> reached = reachable(graph, v);
      CHECK(graph::component_of(graph, v).vertex == reached);
      CHECK(size[parts.of[v]] == std::count(reached.begin(), reached.end(), true));
      largest = std::max(largest, size[parts.of[v]]);
    }
    const graph::Part part = graph::largest_component(graph);
    CHECK(std::count(part.vertex.begin(), part.vertex.end(), true) == largest);
  }
}

TEST_CASE("parts hold no edge without its vertices", "[components]") {
  Random random(6);
  for (int trial = 0; trial < 200; ++trial) {
    const Graph graph = random_graph(random);
    const graph::PoseIndex poses = graph::pose_index(graph);
    const auto last = static_cast<Index>(poses.pose.size()) - 1;
    const graph::Part parts[] = {graph::first_steps(graph, poses, last, 2),
                                 graph::pose_range(graph, poses, 1, last),
                                 graph::of_ids(graph, {{0, 2}, {5, 9}})};
    for (const graph::Part& part : parts) {
      for (Index e = 0; e < graph.edges(); ++e) {
        for (Index v : graph.edge(e)) CHECK((!part.edge[e] || part.vertex[v]));
      }
    }
    for (Index v = 0; v < graph.vertices(); ++v) {
      CHECK(parts[2].vertex[v] == (graph.id[v] <= 2 || (graph.id[v] >= 5 && graph.id[v] <= 9)));
      if (poses.index[v] >= 0) CHECK(parts[1].vertex[v] == (poses.index[v] >= 1));
    }
  }
}
