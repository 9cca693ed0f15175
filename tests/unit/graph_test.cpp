#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "formats/formats.h"
#include "lib/graph/pattern.h"
#include "lib/graph/replay.h"
#include "lib/text/words.h"
#include "tests/unit/common.h"

using namespace sg;
using namespace sg::test;

namespace {

std::string cause(const std::string& text, const formats::ReadOptions& options = {}) {
  try {
    formats::read_graph_text(text::text_of(text), "test.g2o", options);
  } catch (const text::Error& error) {
    return text::message(error);
  }
  return "";
}

// Poses 0, 10, 20, ... and landmarks in between, VERTEX lines shuffled; edges of every role,
// doubled and unary ones too.
std::string random_graph(Random& random) {
  const int poses = draw(random, 1, 8);
  const int landmarks = draw(random, 0, 5);
  std::vector<std::string> vertices;
  for (int k = 0; k < poses; ++k)
    vertices.push_back("VERTEX_SE2 " + std::to_string(10 * k) + " 0 0 0\n");
  for (int k = 0; k < landmarks; ++k)
    vertices.push_back("VERTEX_XY " + std::to_string(10 * k + 5) + " 0 0\n");
  shuffle(random, vertices);
  std::string text;
  for (const auto& line : vertices) text += line;
  for (int k = draw(random, 0, 25); k > 0; --k) {
    const std::string a = std::to_string(10 * draw(random, 0, poses - 1));
    const std::string b = std::to_string(10 * draw(random, 0, poses - 1));
    const std::string l = std::to_string(10 * draw(random, 0, std::max(landmarks - 1, 0)) + 5);
    const std::string m = std::to_string(10 * draw(random, 0, std::max(landmarks - 1, 0)) + 5);
    const int kind = landmarks > 0 ? draw(random, 0, 4) : draw(random, 0, 1);
    if (kind == 0) text += "EDGE_PRIOR_SE2 " + a + " 0 0 0 1 0 0 1 0 1\n";
    if (kind == 1) text += "EDGE_SE2 " + a + " " + b + " 0 0 0 1 0 0 1 0 1\n";
    if (kind == 2 || kind == 3) text += "EDGE_SE2_XY " + a + " " + l + " 0 0 1 0 1\n";
    if (kind == 4) text += "EDGE_POINTXY " + l + " " + m + " 0 0 1 0 1\n";
  }
  return text;
}

// The definition of time, word for word: goes step by step and asks every landmark and every edge
// whether its turn is now.
std::vector<Index> literal_edge_steps(const Graph& graph, int min_obs) {
  const graph::PoseIndex poses = graph::pose_index(graph);
  std::vector<bool> present(graph.vertices(), false);
  std::vector<Index> step_of(graph.edges(), -1);
  std::vector<bool> observed(graph.vertices(), false);  // by any pose, ever
  for (Index e = 0; e < graph.edges(); ++e) {
    const auto ends = graph.edge(e);
    if (std::none_of(ends.begin(), ends.end(), [&](Index v) { return poses.index[v] >= 0; }))
      continue;
    for (Index v : ends) observed[v] = true;
  }
  for (Index step = 0; step < static_cast<Index>(poses.pose.size()); ++step) {
    present[poses.pose[step]] = true;
    std::map<Index, int> observations;
    for (Index e = 0; e < graph.edges(); ++e) {
      Index last = -1;
      for (Index v : graph.edge(e)) last = std::max(last, poses.index[v]);
      if (last < 0 || last > step) continue;
      for (Index v : graph.edge(e)) observations[v] += graph.role(v) == graph::Role::landmark;
    }
    for (const auto& [v, count] : observations) {
      if (graph.role(v) == graph::Role::landmark && count >= min_obs) present[v] = true;
    }
    for (bool changed = true; changed;) {
      changed = false;
      for (Index e = 0; e < graph.edges(); ++e) {
        const auto ends = graph.edge(e);
        if (std::any_of(ends.begin(), ends.end(), [&](Index v) { return poses.index[v] >= 0; }))
          continue;
        if (std::none_of(ends.begin(), ends.end(), [&](Index v) { return present[v]; })) continue;
        for (Index v : ends) {
          if (present[v] || observed[v]) continue;
          changed = true;
          present[v] = true;
        }
      }
    }
    for (Index e = 0; e < graph.edges(); ++e) {
      const auto ends = graph.edge(e);
      if (step_of[e] < 0 &&
          std::all_of(ends.begin(), ends.end(), [&](Index v) { return present[v]; })) {
        step_of[e] = step;
      }
    }
  }
  return step_of;
}

}  // namespace

TEST_CASE("a replay adds every edge at the step that the definition gives it", "[graph]") {
  Random random(7);
  for (int round = 0; round < 500; ++round) {
    const Graph graph = graph_of(random_graph(random));
    const int min_obs = draw(random, 1, 3);
    CHECK(graph::replay(graph, graph::pose_index(graph), min_obs).edge_step ==
          literal_edge_steps(graph, min_obs));
  }
}

TEST_CASE("the pose index is the rank by id, whatever the order of lines", "[graph]") {
  const Graph graph =
      graph_of("VERTEX_SE2 9 0 0 0\nVERTEX_XY 5 0 0\nVERTEX_SE2 2 0 0 0\nVERTEX_SE2 4 0 0 0\n");
  const graph::PoseIndex poses = graph::pose_index(graph);
  REQUIRE(graph.id == std::vector<Id>{2, 4, 5, 9});
  CHECK(poses.pose == std::vector<Index>{0, 1, 3});
  CHECK(poses.index == std::vector<Index>{0, 1, -1, 2});
  CHECK(graph::file_order(graph) == std::vector<Index>{3, 2, 0, 1});
}

TEST_CASE("edges have roles, and a gap in odometry starts a segment", "[graph]") {
  const Graph graph = graph_of(
      "EDGE_SE2 0 1 0 0 0 1 0 0 1 0 1\nEDGE_SE2 3 2 0 0 0 1 0 0 1 0 1\nEDGE_SE2 0 3 0 0 0 1 0 0 1 "
      "0 1\n"
      "EDGE_SE2_XY 1 7 0 0 1 0 1\nEDGE_PRIOR_SE2 0 0 0 0 1 0 0 1 0 1\n");
  const graph::PoseIndex poses = graph::pose_index(graph);
  CHECK(graph::edge_roles(graph, poses) ==
        std::vector<graph::EdgeRole>{graph::EdgeRole::odometry, graph::EdgeRole::odometry,
                                     graph::EdgeRole::loop_closure, graph::EdgeRole::observation,
                                     graph::EdgeRole::other});
  CHECK(graph::segments(graph, poses) == std::vector<Index>{0, 2});
}

TEST_CASE("adjacency is the graph of A^T A", "[graph]") {
  Random random(11);
  for (int round = 0; round < 200; ++round) {
    const graph::GraphPattern graph = graph::graph_pattern(graph_of(random_graph(random)));
    const graph::Pattern& pattern = graph.pattern;
    std::vector<std::set<Index>> expected(pattern.variables());
    for (Index r = 0; r < pattern.rows.size(); ++r) {
      for (Index i : pattern.rows[r]) {
        for (Index j : pattern.rows[r]) {
          if (i != j) expected[i].insert(j);
        }
      }
    }
    const graph::Adjacency actual = graph::adjacency(pattern);
    REQUIRE(actual.size() == pattern.variables());
    for (Index j = 0; j < actual.size(); ++j) {
      CHECK(std::vector<Index>(actual[j].begin(), actual[j].end()) ==
            std::vector<Index>(expected[j].begin(), expected[j].end()));
    }
  }
}

TEST_CASE("fixed vertices are no variables, and a factor counts a variable once", "[graph]") {
  const Graph graph = graph_of(
      "VERTEX_SE2 1 0 0 0\nVERTEX_SE2 2 0 0 0\nVERTEX_SE2 3 0 0 0\nFIX 1 3\nEDGE_SE2 1 2 0 0 0 1 0 "
      "0 1 0 1\n"
      "EDGE_SE2 2 2 0 0 0 1 0 0 1 0 1\nEDGE_SE2 1 3 0 0 0 1 0 0 1 0 1\n");
  const graph::GraphPattern pattern = graph::graph_pattern(graph);
  CHECK(pattern.variable_vertex == std::vector<Index>{1});
  CHECK(pattern.vertex_variable == std::vector<Index>{-1, 0, -1});
  CHECK(pattern.pattern.rows.begin == std::vector<Index>{0, 1, 2, 2});
  CHECK(pattern.pattern.rows.items == std::vector<Index>{0, 0});
}

TEST_CASE("a wrong line is named with its cause", "[graph]") {
  const std::string vertex = "VERTEX_SE2 0 0 0 0\n";
  CHECK(cause(vertex + "VERTEX_SE2 x 0 0 0\n") == "test.g2o:2: 'x' is not a vertex id");
  CHECK(cause(vertex + "EDGE_SE2 0 0 0 0 0 1 0 0 1 0 1.2.3\n") ==
        "test.g2o:2: '1.2.3' is not a number");
  CHECK(cause(vertex + "EDGE_SE2 0 42 0 0 0 1 0 0 1 0 1\n") ==
        "test.g2o:2: EDGE_SE2 joins vertex 42, which the file does not define");
  CHECK(cause(vertex + "EDGE_SE2 0 0 0 0 0 1 0 0 1") ==
        "test.g2o:2: EDGE_SE2 wants 9 numbers here, the line has 7");
  CHECK(cause(vertex + vertex) == "test.g2o:2: vertex 0 is defined a second time");
  CHECK(cause("VERTEX_SE2 9223372036854775808 0 0 0\n") ==
        "test.g2o:1: '9223372036854775808' is above 2^63 - 1, too large for a vertex id");
  CHECK(cause("NONSENSE 1 2\n") ==
        "test.g2o:1: unknown tag 'NONSENSE' (teach it by --vertex, --edge or --params, or --alias "
        "it to a known one; --skip-unknown leaves such lines out)");
  CHECK(cause("VERTEX_SE2 9223372036854775807 0 0 0\n").empty());
}

TEST_CASE("reading goes on after a defect, without its line", "[graph]") {
  std::vector<std::string> said;
  formats::ReadOptions options;
  options.complaint = [&](const text::Error& error) { said.push_back(text::message(error)); };
  const Graph graph =
      formats::read_graph_text(text::text_of("VERTEX_XY 1 0\nVERTEX_XY 2 0 0\nEDGE_POINTXY 2 2 0 "
                                             "0 1 0 1\nEDGE_POINTXY 1 2 0 0 1 0 1\nFIX 1 2\n"),
                               "test.g2o", options);
  CHECK(said == std::vector<std::string>{
                    "test.g2o:1: VERTEX_XY wants 2 numbers here, the line has 1",
                    "test.g2o:4: EDGE_POINTXY joins vertex 1, which the file does not define",
                    "test.g2o:5: FIX names vertex 1, which the file does not define"});
  CHECK(graph.id == std::vector<Id>{2});
  CHECK(graph.edges() == 1);
  CHECK(graph.fixed[0]);
}

TEST_CASE("a taught tag has its dimension, role and arity", "[graph]") {
  formats::ReadOptions options;
  options.vertex_types = {"VERTEX_WHEEL:BASE:5:pose"};
  options.edge_types = {"EDGE_THREE:3"};
  const std::string text =
      "VERTEX_WHEEL:BASE 1 0.5\nVERTEX_WHEEL:BASE 2\nVERTEX_XY 3 0 0\nEDGE_THREE 1 2 3\n";
  const Graph graph = formats::read_graph_text(text::text_of(text), "test.g2o", options);
  REQUIRE(graph.vertices() == 3);
  CHECK(graph.dim(0) == 5);
  CHECK(graph.role(0) == graph::Role::pose);
  REQUIRE(graph.edges() == 1);
  CHECK(graph.edge(0).size() == 3);

  for (const std::string wrong : {"A", "A:0:pose", "A:3:boss", ":3:pose", "A:3", "A:-1:pose"}) {
    formats::ReadOptions bad;
    bad.vertex_types = {wrong};
    CHECK(cause("", bad).starts_with("--vertex wants TAG:DIM:ROLE"));
  }
}
