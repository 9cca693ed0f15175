#include "formats/formats.h"

#include <catch2/catch.hpp>

#include "formats/g2o.h"
#include "formats/thin.h"
#include "lib/elim/score.h"
#include "lib/graph/replay.h"
#include "lib/order/order.h"
#include "tests/unit/common.h"

using namespace sg;

namespace {

Graph graph_of(const std::string& text, const std::string& format = "") {
  formats::ReadOptions options;
  options.format = format;
  return formats::read_graph_text(text::text_of(text), "test", options);
}

std::vector<std::string> complaints_of(const std::string& text, const std::string& format = "") {
  std::vector<std::string> messages;
  formats::ReadOptions options;
  options.format = format;
  options.complaint = [&](const text::Error& error) { messages.push_back(text::message(error)); };
  formats::read_graph_text(text::text_of(text), "test", options);
  return messages;
}

std::vector<double> numbers_of(const Graph& graph, Index e) {
  std::vector<double> numbers;
  graph::edge_numbers(graph, e, numbers);
  return numbers;
}

std::vector<double> estimate_of(const Graph& graph, Index v) {
  std::vector<double> numbers;
  graph::vertex_numbers(graph, v, numbers);
  return numbers;
}

std::string format_of(std::string_view text) {
  for (const formats::ReadFormat& format : formats::read_formats()) {
    if (format.looks_like(text)) return std::string(format.name);
  }
  return "";
}

// What two ways of reading one text say of it.
struct Read {
  Graph graph;
  std::vector<std::string> complaints;
};

Read read_whole(const std::string& text) {
  std::vector<std::string> said;
  const auto note = [&](const text::Error& error) { said.push_back(text::message(error)); };
  Graph graph = formats::parse_g2o(text::text_of(text), "test", graph::builtin_tags(), note);
  return {std::move(graph), said};
}

Read read_thinly(const std::string& text, test::Random& random, const formats::Thin& thin) {
  std::vector<std::string> said;
  const auto note = [&](const text::Error& error) { said.push_back(text::message(error)); };
  std::size_t at = 0;
  const auto next = [&] {
    const auto size = static_cast<std::size_t>(test::draw(random, 1, 200));
    const auto block = std::string_view(text).substr(std::min(at, text.size()), size);
    at += size;
    return block;
  };
  Graph graph = formats::parse_g2o_thinly(next, "test", graph::builtin_tags(), note, {}, thin);
  return {std::move(graph), said};
}

}  // namespace

TEST_CASE("a text that is not kept gives the same graph, and lines of the same numbers",
          "[formats]") {
  test::Random random(5);
  for (const char* name : {"walk.g2o", "types-se2.g2o", "types-se3.g2o"}) {
    std::string text(test::test_graph(name).text.view);
    for (int round = 0; round < 20; ++round) {
      if (round > 10)  // defects
        text[static_cast<std::size_t>(test::draw(random, 0, static_cast<int>(text.size()) - 1))] =
            "x\n 7-"[test::draw(random, 0, 4)];
      const formats::Thin thin{test::draw(random, 0, 9), test::draw(random, 1, 5)};
      const Read whole = read_whole(text), thinned = read_thinly(text, random, thin);
      CAPTURE(name, round, text);
      CHECK(thinned.complaints == whole.complaints);
      const Graph &a = whole.graph, &b = thinned.graph;
      REQUIRE((a.id == b.id && a.vertex_type == b.vertex_type && a.fixed == b.fixed));
      REQUIRE((a.edge_type == b.edge_type && a.edge_vertices.items == b.edge_vertices.items &&
               a.edge_vertices.begin == b.edge_vertices.begin));
      CHECK((a.order_method == b.order_method && a.edges_only == b.edges_only));
      for (Index v = 0; v < a.vertices() && !a.edges_only; ++v)
        CHECK(graph::line_at(a, a.vertex_line[v]) == graph::line_at(b, b.vertex_line[v]));
      Index gone = 0;
      for (Index e = 0; e < a.edges(); ++e) {
        CHECK(graph::line_number(a, a.edge_line[e]) == graph::line_number(b, b.edge_line[e]));
        const auto line = graph::line_at(b, b.edge_line[e]);
        gone += line.empty();
        CHECK((line.empty() || line == graph::line_at(a, a.edge_line[e])));
      }
      if (round <= 10 && thin.every == 1) CHECK(gone == 0);
      if (round <= 10 && thin.every > 1 && thin.first + 2 < a.edges()) CHECK(gone > 0);
    }
  }
}

TEST_CASE("formats are told by content", "[formats]") {
  CHECK(format_of("ODOMETRY 0 1 1 0 0 1 0 0 1 0 1\n") == "isam");
  CHECK(format_of("\r\n  # comment\r\n\r\n LANDMARK 0 1 1 0 1 0 1\r\n") == "isam");
  CHECK(format_of("POINT3 0 1 1 0 1 0 1\n") == "isam");
  CHECK(format_of("EDGE2 0 1\nEDGE2 1 2\n") == "isam");
  CHECK(format_of("EDGE3 0 1") == "isam");
  CHECK(format_of("EDGE2 0 1\nODOMETRY 1 2\n") == "isam");
  CHECK(format_of("EDGE2 0 1\nVERTEX2 0 0 0 0\n") == "toro");
  CHECK(format_of("VERTEX2 0 0 0 0\nEDGE2 0 1\n") == "toro");
  CHECK(format_of("# c\nVERTEX3 0 0 0 0\nEDGE3 0 1\n") == "toro");
  CHECK(format_of("FIX 0\nVERTEX2 0 0 0 0\n") == "toro");
  CHECK(format_of("VERTEX_SE2 0 0 0 0\nODOMETRY 0 1\n") == "g2o");
  CHECK(format_of("EDGE_SE2 0 1\nEDGE2 0 1\n") == "g2o");
  CHECK(format_of("EDGE2 0 1\nEDGE_SE2 0 1\n") == "g2o");
  CHECK(format_of("") == "g2o");
  CHECK(format_of("EDGE22 0 1\n") == "g2o");
}

TEST_CASE("iSAM: square roots become information", "[formats]") {
  const Graph graph = graph_of("ODOMETRY 0 1 1.50 2e0 +.5 1 2 3 4 5 6\r\n");
  CHECK(graph.edges_only);
  // R^T R of R = [1 2 3; 0 4 5; 0 0 6]
  CHECK(numbers_of(graph, 0) == std::vector<double>{1.5, 2, .5, 1, 2, 3, 20, 26, 70});
  CHECK(graph::line_at(graph, graph.edge_line[0]).starts_with("EDGE_SE2 0 1 1.50 2e0 +.5 "));
}

TEST_CASE("iSAM: landmarks are numbered apart from poses", "[formats]") {
  const Graph graph = graph_of(
      "ODOMETRY 0 7 1 0 0 1 0 0 1 0 1\n"
      "LANDMARK 7 9 1 0 2 1 3\n"
      "LANDMARK 0 7 1 0 2 0 2\n");
  REQUIRE(graph.id == std::vector<Id>{0, 7, 15, 17});
  CHECK(graph.role(0) == graph::Role::pose);
  CHECK(graph.role(1) == graph::Role::pose);
  CHECK(graph.role(2) == graph::Role::landmark);
  CHECK(graph.role(3) == graph::Role::landmark);
  CHECK(graph.edge(1)[1] == 3);
  CHECK(numbers_of(graph, 1) == std::vector<double>{1, 0, 4, 2, 10});
  const auto beyond =
      complaints_of("ODOMETRY 0 7 1 0 0 1 0 0 1 0 1\nLANDMARK 0 9223372036854775807 1 0 1 0 1\n");
  REQUIRE(beyond.size() == 1);
  CHECK(beyond[0].starts_with("test:2: "));
}

TEST_CASE("iSAM: points in space come with an identity offset", "[formats]") {
  const Graph graph = graph_of(
      "EDGE3 0 1 1 2 3 0 0 0 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 3 0 4 5 0 0\n"
      "POINT3 1 0 4 5 6 1 0 0 1 0 2");
  REQUIRE(graph.params.size() == 1);
  CHECK(graph::edge_params(graph, 1) == std::vector<Id>{graph.params[0].id});
  const auto n = numbers_of(graph, 0);
  CHECK(std::vector<double>(n.begin(), n.begin() + 7) == std::vector<double>{1, 2, 3, 0, 0, 0, 1});
  // Rotation rows and columns are over half the rotation vector: R_rr^T R_rr = [9 0 12; 0 25 0;
  // 12 0 16], times four.
  CHECK(std::vector<double>(n.end() - 6, n.end()) == std::vector<double>{36, 0, 48, 100, 0, 64});
}

TEST_CASE("TORO: its own order of the information", "[formats]") {
  const Graph graph = graph_of(
      "VERTEX2 0 0 0 0\nVERTEX2 1 1 0 0\n"
      "EDGE2 0 1 1 2 3 11 12 22 33 13 23\n");
  CHECK(numbers_of(graph, 0) == std::vector<double>{1, 2, 3, 11, 12, 13, 22, 23, 33});
  CHECK(graph.type_of_vertex(0).tag == "VERTEX_SE2");
}

TEST_CASE("TORO: roll, pitch and yaw become a quaternion", "[formats]") {
  const double a = 0.3;
  const Graph graph = graph_of("VERTEX3 5 1 2 3 0 0 0.3\nVERTEX3 6 1 2 3 0.3 0 0\n");
  const auto yaw = estimate_of(graph, 0);
  CHECK(yaw[5] == Approx(std::sin(a / 2)));
  CHECK(yaw[6] == Approx(std::cos(a / 2)));
  const auto roll = estimate_of(graph, 1);
  CHECK(roll[3] == Approx(std::sin(a / 2)));
}

TEST_CASE("foreign formats: line numbers hold and reading goes on", "[formats]") {
  const auto messages = complaints_of(
      "# comment\r\n"
      "ODOMETRY 0 1 1 0 0 1 0 0 1 0 1\r\n"
      "\r\n"
      "ODOMETRY 1 2 1 0 zero 1 0 0 1 0 1\r\n"
      "ODOMETRY 1 2 1 0 0 1 0 0 1 0\r\n"
      "ODOMETRY 1 -2 1 0 0 1 0 0 1 0 1\r\n"
      "ODOMETRY 1 2 1 0 0 1 0 0 1 0 1 1\r\n"
      "MYSTERY 1 2\r\n"
      "ODOMETRY 1 2 1 0 0 1 0 0 1 0 1");
  REQUIRE(messages.size() == 5);
  CHECK(messages[0] == "test:4: 'zero' is not a number");
  CHECK(messages[1] == "test:5: the line ends before its last number");
  CHECK(messages[2] == "test:6: '-2' is not a pose id");
  CHECK(messages[3] == "test:7: '1' stands where the line should end");
  CHECK(messages[4].starts_with("test:8: unknown tag 'MYSTERY'"));
  CHECK(complaints_of("VERTEX2 0 0 0\n", "toro").size() == 1);
}

TEST_CASE("public iSAM files have the published elimination complexity", "[formats][data]") {
  const auto folder = test::public_graphs();
  if (!folder) return;
  const auto [name, ec] = GENERATE(table<std::string, std::string>(
      {{"victoriaPark", "3348952"}, {"manhattanOlson3500", "7738470"}, {"sphere400", "17237880"}}));
  const Graph graph = formats::read_graph(*folder + "/" + name + ".isam.txt");
  const graph::GraphPattern pattern = graph::graph_pattern(graph);
  const graph::Order order =
      order::elimination_order("colamd", pattern.pattern, order::order_options(graph, pattern));
  CHECK(elim::to_string(elim::elimination_complexity(pattern.pattern, order)) == ec);
}

TEST_CASE("a defective line leaves nothing behind", "[formats]") {
  formats::ReadOptions options;
  int defects = 0;
  options.complaint = [&](const text::Error&) { ++defects; };
  const Graph graph = formats::read_graph_text(
      text::text_of("VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 0 0 x\nPARAMS_SE2OFFSET 0 1 x 0\nFIX 0 x\n"
                    "EDGE_SE2 0 0 1 0 0 1 0 0 1 0 x\nEDGE_SE2_LOTSOFXY 0 3 0 0\n"),
      "test", options);
  CHECK(defects == 5);
  CHECK(graph.vertices() == 1);
  CHECK(graph.edges() == 0);
  CHECK(graph.edge_vertices.begin == std::vector<Index>{0});
  CHECK(graph.params.empty());
  CHECK_FALSE(graph.fixed[0]);
}

TEST_CASE("counted edges with absurd counts are defects, not allocations", "[formats]") {
  for (const std::string count : {"3000000000", "9223372036854775807", "715827883"}) {
    const auto messages =
        complaints_of("VERTEX_SE2 0 0 0 0\nEDGE_SE3_LOTSOF_XYZ 0 " + count + " 1");
    REQUIRE(messages.size() == 1);
    CHECK(messages[0] == "test:2: the line ends before its " + count + " vertex ids");
  }
}
