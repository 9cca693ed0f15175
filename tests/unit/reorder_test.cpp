#include "formats/reorder.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>
#include <set>

#include "formats/formats.h"
#include "lib/text/words.h"
#include "tests/unit/common.h"

using namespace sg::test;

namespace {

using sg::Index;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

bool is_vertex_or_data(std::string_view line) {
  const auto tag = sg::text::next_word(line);
  return tag.starts_with("VERTEX") || tag == "ROBOTLASER1";
}

// Vertices of random ids with 0 to 2 data lines, edges, comments and blank lines in between; the
// last line ends without a newline half of the time.
std::string odd_file(Random& random, Index n) {
  std::vector<int> ids(n);
  std::iota(ids.begin(), ids.end(), 3);
  shuffle(random, ids);
  std::string text;
  for (const int id : ids) {
    text += "VERTEX_SE2 " + std::to_string(id) + " " + std::to_string(draw(random, 0, 99)) +
            ".50 0 0\n";
    for (auto k = draw(random, 0, 2); k > 0; --k)
      text += "ROBOTLASER1 " + std::to_string(id) + "\n";
    if (draw(random, 0, 2) == 0) text += "EDGE_SE2 3 4 1 0 0 1 0 0 1 0 1\n";
    if (draw(random, 0, 5) == 0)
      text += "FIX " + std::to_string(ids[draw(random, 0, n - 1)]) + "\n";
    if (draw(random, 0, 2) == 0) text += "# a comment\n";
    if (draw(random, 0, 2) == 0) text += "  \r\n";
  }
  if (draw(random, 0, 1) == 0) text.pop_back();
  return text;
}

// Reads as g2o does, line by line: nothing names a vertex ahead of its line.
void check_one_pass(const std::string& text) {
  std::set<std::string_view> known;
  for (std::string_view rest = text; !rest.empty();) {
    auto line = sg::text::next_line(rest);
    const auto tag = sg::text::next_word(line);
    if (tag.starts_with("VERTEX")) known.insert(sg::text::next_word(line));
    for (int ends = tag.starts_with("EDGE") ? 2 : tag == "FIX" ? 1 : 0; ends > 0; --ends)
      CHECK(known.contains(sg::text::next_word(line)));
  }
}

}  // namespace

TEST_CASE("reordered VERTEX lines change places and nothing else", "[reorder]") {
  Random random(5);
  for (int trial = 0; trial < 200; ++trial) {
    const Index n = draw(random, 2, 21);
    const std::string text = odd_file(random, n);
    const sg::Graph graph = graph_of(text);
    const sg::graph::Order order = shuffled(random, n);
    sg::formats::Changes changes = sg::formats::unchanged(graph);
    changes.edits = sg::formats::reordered(graph, order);
    StringSink sink;
    sg::formats::write_changed(graph, std::move(changes), "", sink);

    const sg::Graph result = graph_of(sink.text);
    CHECK(sg::graph::file_order(result) == order);
    CHECK(result.id == graph.id);
    CHECK(sink.text.size() <= text.size() + 1);  // a newline behind the last line
    check_one_pass(sink.text);
    for (Index v = 0; v < n; ++v) {
      const auto lines = [&](const sg::Graph& g) {
        const auto [begin, end] = sg::formats::vertex_extent(g, v);
        return lines_of(std::string(g.text.view.substr(begin, end - begin)));
      };
      CHECK(lines(result) == lines(graph));
    }
    auto before = lines_of(text);
    auto after = lines_of(sink.text);
    std::erase_if(before, is_vertex_or_data);
    std::erase_if(after, is_vertex_or_data);
    CHECK(before == after);
  }
}

TEST_CASE("an order that is the file's own edits nothing where a reader in one pass loses nothing",
          "[reorder]") {
  const std::string vertices = "VERTEX_SE2 7 0 0 0\nROBOTLASER1 7\nVERTEX_SE2 3 0 0 0\n";
  const auto edits_of = [](const sg::Graph& graph) {
    return sg::formats::reordered(graph, sg::graph::file_order(graph)).size();
  };
  CHECK(edits_of(graph_of(vertices + "FIX 3\nEDGE_SE2 3 7 1 0 0 1 0 0 1 0 1\n")) == 0);
  CHECK(edits_of(graph_of("FIX 3\n" + vertices)) > 0);
  CHECK(edits_of(graph_of("EDGE_SE2 3 7 1 0 0 1 0 0 1 0 1\n" + vertices)) > 0);
}

TEST_CASE("sg-order comments are found and the last one counts", "[reorder]") {
  const sg::Graph graph = sg::formats::read_graph_text(
      sg::text::text_of("# sg-order: amd\nVERTEX_SE2 1 0 0 0\n  # sg-order: metis with care\n"
                        "# sg-order -m id\n# sg-ordered: no\n"),
      "test");
  CHECK(graph.order_method == "metis");
  REQUIRE(graph.order_lines.size() == 2);
  CHECK(sg::graph::line_at(graph, graph.order_lines[0]) == "# sg-order: amd");
  CHECK(sg::graph::line_number(graph, graph.order_lines[1]) == 3);
}
