#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

#include "formats/formats.h"
#include "lib/factor/model.h"
#include "lib/graph/linear.h"
#include "lib/text/words.h"

using namespace sg;

namespace {

// The lines of a table of sg-graph(5), cell by cell, by tag.
using Cells = std::map<std::string, std::vector<std::string>, std::less<>>;
Cells manual_table(const std::string& section) {
  std::ifstream page(SGTOOLS_TESTDATA "/../man/sg-graph.5");
  REQUIRE(page);
  Cells table;
  std::string line;
  while (std::getline(page, line) && line != ".Sh " + section) continue;
  while (std::getline(page, line) && !line.starts_with(".Sh ")) {
    if (!line.starts_with(".It ") || line.starts_with(".It Sy")) continue;
    std::vector<std::string> cells(1);
    std::istringstream words(line.substr(4));
    for (std::string word; words >> word;) {
      if (word == "Ta") {
        cells.emplace_back();
      } else {
        cells.back() += (cells.back().empty() ? "" : " ") + word;
      }
    }
    table[cells[0]] = cells;
  }
  return table;
}

// The manual's short name of a vertex.
std::string short_name(graph::VertexTag type) {
  if (type == graph::VertexTag::se3 || type == graph::VertexTag::toro3) return "SE3";
  if (type == graph::VertexTag::toro2) return "SE2";
  if (type == graph::VertexTag::expmap) return "SE3EXPMAP";
  if (type == graph::VertexTag::sim3) return "SIM3";
  return std::string(graph::name(type)).substr(std::string("VERTEX_").size());
}

}  // namespace

TEST_CASE("the manual's tables are the registry", "[types]") {
  const Cells vertices = manual_table("VERTICES"), edges = manual_table("EDGES");
  CHECK(vertices.size() == graph::vertex_rows.size());
  for (const graph::VertexRow& row : graph::vertex_rows) {
    INFO(row.tag);
    const auto& cells = vertices.at(std::string(row.tag));
    REQUIRE(cells.size() == 4);
    CHECK(cells[1] == std::to_string(graph::space_dim(row.space)));
    CHECK(cells[2] == graph::name(row.role));
  }
  CHECK(edges.size() == graph::edge_rows.size());
  for (const graph::EdgeRow& row : graph::edge_rows) {
    INFO(row.tag);
    const auto& cells = edges.at(std::string(row.tag));
    std::string ids = row.ends.size > 0 ? short_name(row.ends[0]) : "any";
    for (int k = 1; k < row.ends.size; ++k) ids += " " + short_name(row.ends[k]);
    if (row.counted) ids += "...";
    for (int k = 0; k < row.params.size; ++k) ids += " P";
    REQUIRE(cells.size() == 3);
    CHECK(cells[1] == (row.counted ? "-" : std::to_string(row.measure.dim)));
    CHECK(cells[2] == ids);
  }
}

TEST_CASE("rows agree with their spaces", "[types]") {
  for (const graph::SpaceRow& row : graph::space_rows) {
    CHECK(row.translation.first + row.translation.size <= row.dim);
    CHECK(row.rotation.first + row.rotation.size <= row.dim);
    CHECK((row.numbers < 0 || row.position <= row.numbers));
    CHECK((row.position == 0 || row.position == row.translation.size));
    if (factor::has_steps(row.space))  // those that move are the first ones
      CHECK(graph::moving_dim(row.space) == (row.space == graph::Space::bal_camera ? 6 : row.dim));
    CHECK((!graph::has_quaternion(row.space) || row.numbers >= 7));
  }
  for (const graph::EdgeRow& row : graph::edge_rows) {
    INFO(row.tag);
    CHECK((row.ends.size >= 1 || graph::is_linear(row.type)));
    CHECK((row.measure.space == graph::Space::none || row.measure.numbers >= 0));
    CHECK((row.measure.order == graph::Triangle::rows || row.measure.dim == 3));
    CHECK((!row.counted || row.ends.size == 2 || graph::is_linear(row.type)));
  }
}

TEST_CASE("types of the registry are known by their enumerators", "[types]") {
  const graph::Tags tags = graph::builtin_tags();
  for (const graph::EdgeRow& row : graph::edge_rows) {
    const graph::TagMeaning* meaning = tags.find(row.tag);
    REQUIRE(meaning);
    CHECK(meaning->kind == graph::LineKind::edge);
    CHECK(graph::EdgeTag{meaning->type} == row.type);
    CHECK(tags.edges[meaning->type].arity == row.ends.size);
  }
  for (const graph::VertexRow& row : graph::vertex_rows) {
    const graph::TagMeaning* meaning = tags.find(row.tag);
    REQUIRE(meaning);
    CHECK(meaning->kind == graph::LineKind::vertex);
    CHECK(graph::VertexTag{meaning->type} == row.type);
  }
  for (const graph::Alias& alias : graph::aliases) {
    REQUIRE(tags.find(alias.means));
    CHECK(tags.find(alias.tag)->type == tags.find(alias.means)->type);
  }
  CHECK(tags.edges[static_cast<int>(graph::EdgeTag::se2)].numbers == 9);
  CHECK(tags.edges[static_cast<int>(graph::EdgeTag::expmap)].numbers == 28);
  CHECK(tags.edges[static_cast<int>(graph::EdgeTag::stereo_se3_project_xyz)].numbers == 14);
  CHECK(tags.edges[static_cast<int>(graph::EdgeTag::se3_lotsof_xyz)].numbers == 3);
  CHECK(tags.edges[static_cast<int>(graph::EdgeTag::gicp)].numbers == -1);
}

TEST_CASE("models are found by type, and a taught type has none", "[types]") {
  CHECK(factor::models().size() == 25);
  for (const factor::Model& model : factor::models()) {
    CHECK(factor::find_model(model.type) == &model);
    CHECK(model.tag == graph::name(model.type));
    CHECK(model.arity == graph::row(model.type).ends.size);
  }
  CHECK(factor::find_model(graph::EdgeTag::plane) == nullptr);
  CHECK(factor::find_model(graph::EdgeTag{static_cast<std::uint8_t>(graph::edge_rows.size())}) ==
        nullptr);
  CHECK(factor::find_model(graph::EdgeTag{255}) == nullptr);
}

TEST_CASE("taught types never share a number with those of the registry", "[types]") {
  graph::Tags tags = graph::builtin_tags();
  graph::teach_edge(tags, "MINE:2");
  graph::teach_edge(tags, "MINE:2");
  CHECK(tags.find("MINE")->type == graph::edge_rows.size());
  CHECK(tags.edges.size() == graph::edge_rows.size() + 1);
  graph::teach_edge(tags, "EDGE_SE2:2");
  CHECK(graph::EdgeTag{tags.find("EDGE_SE2")->type} == graph::EdgeTag::se2);
  for (std::size_t k = tags.edges.size(); k < 256; ++k) {
    graph::teach_edge(tags, "MINE" + std::to_string(k) + ":2");
  }
  CHECK(tags.find("MINE255")->type == 255);
  CHECK_THROWS_AS(graph::teach_edge(tags, "ONE_MORE:2"), text::Error);
}

TEST_CASE("information comes row by row, whatever the order of its line", "[types]") {
  formats::ReadOptions options;
  options.format = "g2o";
  const Graph graph = formats::read_graph_text(
      text::text_of("VERTEX2 0 0 0 0\nVERTEX2 1 1 0 0\nEDGE2 0 1 1 2 3 11 12 22 33 13 23 7\n"),
      "test", options);
  std::vector<double> numbers;
  graph::edge_numbers(graph, 0, numbers);
  CHECK(numbers == std::vector<double>{1, 2, 3, 11, 12, 13, 22, 23, 33, 7});
}
