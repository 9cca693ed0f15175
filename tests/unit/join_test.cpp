// Graphs with other ids, several as one, and what two of them differ in.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <numeric>
#include <set>

#include "formats/applied.h"
#include "formats/merge.h"
#include "formats/scale.h"
#include "lib/factor/initialize.h"
#include "lib/factor/linearize.h"
#include "lib/graph/cut.h"
#include "lib/graph/diff.h"
#include "lib/text/words.h"
#include "tests/unit/common.h"

using namespace sg;
using namespace sg::test;

namespace {

std::string text_of(const Graph& graph) {
  return std::string(graph.text.view);
}

Graph with_changes(const Graph& graph, formats::Changes changes) {
  return formats::applied(graph, std::move(changes), {});
}

Graph merge(std::vector<Graph> graphs, const formats::MergeOptions& options) {
  StringSink sink;
  formats::write_merged(graphs, formats::merged(graphs, options, "sg-merge"), "", sink);
  return graph_of(sink.text);
}

double chi2(const Graph& graph) {
  const factor::Problem problem = factor::make_problem(graph);
  return factor::chi2(problem, factor::start_values(problem));
}

// Poses and points with odd ids, edges between them (parallel ones, too), FIX lines, in a random order of lines.
std::string odd_graph(Random& random) {
  std::set<int> ids;
  while (static_cast<int>(ids.size()) < draw(random, 2, 7)) ids.insert(draw(random, 0, 40));
  const std::vector<int> id(ids.begin(), ids.end());
  std::vector<std::string> lines;
  std::vector<bool> pose;
  for (const int v : id) {
    pose.push_back(draw(random, 0, 2) > 0);
    lines.push_back((pose.back() ? "VERTEX_SE2 " : "VERTEX_XY ") + std::to_string(v) +
                    (pose.back() ? " 1.50 2 0" : "  1 -2.0"));
  }
  const int n = static_cast<int>(id.size());
  for (int k = draw(random, 0, 12); k > 0; --k) {
    const int a = draw(random, 0, n - 1), b = draw(random, 0, n - 1);
    if (!pose[a]) continue;
    const std::string ends = std::to_string(id[a]) + "  " + std::to_string(id[b]) + " ";
    const std::string x = std::to_string(draw(random, 0, 1));
    lines.push_back(pose[b] ? "EDGE_SE2 " + ends + x + " 0 0 1 0 0 1 0 1"
                            : " EDGE_SE2_XY " + ends + x + " 0 1 0 1\r");
  }
  if (draw(random, 0, 1) == 0)
    lines.push_back("FIX " + std::to_string(id[0]) + "\t" + std::to_string(id[n - 1]) + " ");
  lines.emplace_back("# 3 4");
  shuffle(random, lines);
  std::string text;
  for (const auto& line : lines) text += line + "\n";
  return text;
}

// Every edge as what it is: type, ids, numbers.
using Said = std::tuple<int, std::vector<Id>, std::vector<double>>;
std::multiset<Said> edges_of(const Graph& graph) {
  std::multiset<Said> edges;
  for (Index e = 0; e < graph.edges(); ++e) {
    std::vector<Id> ids;
    for (const Index v : graph.edge(e)) ids.push_back(graph.id[v]);
    std::vector<double> numbers;
    graph::edge_numbers(graph, e, numbers);
    edges.emplace(graph.edge_type[e], ids, numbers);
  }
  return edges;
}

TEST_CASE("other ids reach every line that names one, and going back gives the same bytes") {
  for (int seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const Graph graph = graph_of(odd_graph(random));
    formats::NewIds ids = formats::same_ids(graph);
    std::vector<Id> fresh(graph.vertices());
    std::iota(fresh.begin(), fresh.end(), Id{1000});
    shuffle(random, fresh);
    ids.vertex = fresh;
    const Graph other = with_changes(graph, formats::renumbered(graph, ids));
    std::map<Id, Id> back;
    for (Index v = 0; v < graph.vertices(); ++v) {
      back[fresh[v]] = graph.id[v];
      const auto w = graph::find_vertex(other, fresh[v]);
      REQUIRE(w);
      CHECK(other.vertex_type[*w] == graph.vertex_type[v]);
      CHECK(other.fixed[*w] == graph.fixed[v]);
    }
    std::multiset<Said> mapped;
    for (auto [type, ends, numbers] : edges_of(other)) {
      for (Id& id : ends) id = back.at(id);
      mapped.emplace(type, ends, numbers);
    }
    CHECK(mapped == edges_of(graph));
    formats::NewIds old = formats::same_ids(other);
    for (Id& id : old.vertex) id = back.at(id);
    CHECK(text_of(with_changes(other, formats::renumbered(other, old))) == text_of(graph));
  }
}

TEST_CASE("counted ids: poses first, in their order") {
  const Graph graph = graph_of(
      "VERTEX_XY 3 0 0\nVERTEX_SE2 7 0 0 0\nVERTEX_SE2 5 0 0 0\nEDGE_SE2 5 7 1 0 0 1 0 0 1 0 1\n"
      "EDGE_SE2_XY 7 3 0 0 1 0 1\n");
  CHECK(formats::counted_ids(graph).vertex == std::vector<Id>{2, 0, 1});
  CHECK(text_of(with_changes(graph, formats::renumbered(graph, formats::counted_ids(graph)))) ==
        "VERTEX_XY 2 0 0\nVERTEX_SE2 1 0 0 0\nVERTEX_SE2 0 0 0 0\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n"
        "EDGE_SE2_XY 1 2 0 0 1 0 1\n");
}

TEST_CASE("an edge that counts its vertices, and one with parameters, are renumbered") {
  const Graph graph = graph_of(
      "VERTEX_SE2 1 0 0 0\nVERTEX_XY 2 0 0\nVERTEX_XY 3 0 0\n"
      "EDGE_SE2_LOTSOFXY 1 2 2 3 5 5 6 6 1 0 0 0 1 0 0 1 0 1\nEDGE_SE2_LOTSOFXY 1 0\n"
      "PARAMS_SE2OFFSET 1 0 0 0\nEDGE_SE2_POINTXY_OFFSET 1 2 1 1 2 1 0 1\n");
  formats::NewIds ids{{10, 20, 30}, {{1, 7}}, {}};
  const std::string text = text_of(with_changes(graph, formats::renumbered(graph, ids)));
  CHECK(text ==
        "VERTEX_SE2 10 0 0 0\nVERTEX_XY 20 0 0\nVERTEX_XY 30 0 0\n"
        "EDGE_SE2_LOTSOFXY 10 2 20 30 5 5 6 6 1 0 0 0 1 0 0 1 0 1\nEDGE_SE2_LOTSOFXY 10 0\n"
        "PARAMS_SE2OFFSET 7 0 0 0\nEDGE_SE2_POINTXY_OFFSET 10 20 7 1 2 1 0 1\n");
}

TEST_CASE("graphs that share nothing are merged: their edges and their chi-squares add up") {
  const std::string se3 = text_of(test_graph("types-se3.g2o"));
  std::string turned = se3;  // the first parameter has other numbers
  turned.replace(turned.find("PARAMS_SE3OFFSET 0 0.1"), 22, "PARAMS_SE3OFFSET 0 0.3");
  const Graph a = graph_of(se3), b = graph_of(turned);
  for (const auto ids : {formats::MergedIds::offset, formats::MergedIds::prefix}) {
    const Graph both = merge({a, b, a}, {ids, {}});
    CHECK(both.vertices() == 3 * a.vertices());
    CHECK(both.edges() == 3 * a.edges());
    CHECK(both.params.size() == a.params.size() + 1);  // the one that differs, under a new id
    CHECK(chi2(both) == Approx(2 * chi2(a) + chi2(b)).epsilon(1e-12));
  }
  CHECK(chi2(a) != Approx(chi2(b)).epsilon(1e-6));
}

TEST_CASE("merged graphs: of ids that are shared one vertex each, of others one a graph") {
  for (int seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const Graph a = graph_of(odd_graph(random)), b = graph_of(odd_graph(random));
    const Id limit = draw(random, -1, 40);
    formats::MergeOptions options;
    if (seed % 2) options.ids = formats::MergedIds::prefix;
    options.shared = {{0, limit}};
    const auto common = [&](Id id) { return id <= limit && graph::find_vertex(a, id).has_value(); };
    const bool clash = std::ranges::any_of(b.id, [&](Id id) {
      return common(id) &&
             a.vertex_type[*graph::find_vertex(a, id)] != b.vertex_type[*graph::find_vertex(b, id)];
    });
    if (clash) {
      CHECK_THROWS_AS(merge({a, b}, options), text::Error);
      continue;
    }
    const Graph both = merge({a, b}, options);
    CHECK(both.vertices() == a.vertices() + b.vertices() - std::ranges::count_if(b.id, common));
    CHECK(both.edges() == a.edges() + b.edges());
    // The edges of both, by ids without what was put in front.
    if (options.ids == formats::MergedIds::prefix) {
      const Id power = std::max(a.id.back(), b.id.back()) < 10 ? 10 : 100;
      std::multiset<Said> plain, wanted = edges_of(a);
      wanted.merge(edges_of(b));
      for (auto [type, ends, numbers] : edges_of(both)) {
        for (Id& id : ends) id = id >= power ? id % power : id;
        plain.emplace(type, ends, numbers);
      }
      CHECK(plain == wanted);
    }
  }
}

TEST_CASE("ids that would not fit are refused, and those that just do are not") {
  const std::string large = "VERTEX_SE2 9223372036854775806 0 0 0\n",
                    small = "VERTEX_SE2 0 0 0 0\n";
  CHECK(merge({graph_of(large), graph_of(small)}, {}).id.back() == 9223372036854775807);
  CHECK_THROWS_AS(merge({graph_of(large), graph_of("VERTEX_SE2 1 0 0 0\n")}, {}), text::Error);
  CHECK_THROWS_AS(merge({graph_of(large), graph_of(small)}, {formats::MergedIds::prefix, {}}),
                  text::Error);
  CHECK(merge({graph_of(large), graph_of(small)}, {formats::MergedIds::keep, {}}).vertices() == 2);
  CHECK_THROWS_AS(merge({graph_of(small), graph_of(small)}, {formats::MergedIds::keep, {}}),
                  text::Error);
}

// The same by multisets.
TEST_CASE("the difference of two graphs") {
  for (int seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const std::string text = odd_graph(random);
    std::string other;
    for (std::string_view rest = text; !rest.empty();) {
      std::string line(text::next_line(rest));
      const bool vertex = line.starts_with("VERTEX");
      if (!vertex && draw(random, 0, 4) == 0) continue;
      if (draw(random, 0, 4) == 0 && line.ends_with(" 1")) line.back() = '3';
      if (vertex && draw(random, 0, 4) == 0) line.back() = '4';
      other += line + "\n";
      if (!vertex && draw(random, 0, 4) == 0) other += line + "\n";
    }
    const Graph a = graph_of(text), b = graph_of(other);
    const graph::Diff diff = graph::diff(a, b);
    std::map<std::pair<int, std::vector<Id>>, std::array<std::multiset<std::vector<double>>, 2>>
        keys;
    for (const auto& [type, ids, numbers] : edges_of(a)) keys[{type, ids}][0].insert(numbers);
    for (const auto& [type, ids, numbers] : edges_of(b)) keys[{type, ids}][1].insert(numbers);
    std::array<std::ptrdiff_t, 3> wanted{}, found{};  // only a, only b, changed
    for (auto& [key, sides] : keys) {
      std::vector<std::vector<double>> x, y;
      std::ranges::set_difference(sides[0], sides[1], std::back_inserter(x));
      std::ranges::set_difference(sides[1], sides[0], std::back_inserter(y));
      const std::size_t changed = std::min(x.size(), y.size());
      wanted[0] += static_cast<std::ptrdiff_t>(x.size() - changed);
      wanted[1] += static_cast<std::ptrdiff_t>(y.size() - changed);
      wanted[2] += static_cast<std::ptrdiff_t>(changed);
    }
    for (const auto& [i, j, by] : diff.edges) ++found[j < 0 ? 0 : i < 0 ? 1 : 2];
    CHECK(found == wanted);
    std::vector<double> x, y;
    std::size_t vertices = 0;
    for (Index v = 0; v < a.vertices(); ++v) {
      graph::vertex_numbers(a, v, x);
      graph::vertex_numbers(b, v, y);
      vertices += x != y || a.fixed[v] != b.fixed[v];
    }
    CHECK(diff.vertices.size() == vertices);
    const graph::Diff same = graph::diff(a, a);
    CHECK((same.vertices.empty() && same.edges.empty() && same.params.empty()));
    const graph::Diff loose = graph::diff(a, b, 10);
    CHECK(std::ranges::none_of(loose.edges, [](const auto& d) { return d.a >= 0 && d.b >= 0; }));
  }
}

TEST_CASE("scaled information scales chi-square and leaves measurements alone") {
  for (const auto* name : {"types-se2.g2o", "types-se3.g2o", "square.toro"}) {
    const Graph graph = test_graph(name);
    std::vector<formats::InformationScale> scales;
    for (std::size_t k = 0; k < graph.tags.edges.size(); ++k) {
      const auto& type = graph.tags.edges[k];
      if (type.measurement >= 0 && !type.counted)
        scales.push_back({static_cast<graph::TypeIndex>(k), 4});
    }
    const Graph scaled = with_changes(graph, formats::scaled(graph, scales));
    const double before = chi2(graph);
    CHECK(chi2(scaled) == Approx(4 * before).epsilon(1e-12).margin(1e-12));
    std::vector<double> x, y;
    for (Index e = 0; e < graph.edges(); ++e) {
      graph::edge_numbers(graph, e, x);
      graph::edge_numbers(scaled, e, y);
      const int measured = graph.type_of_edge(e).measurement;
      REQUIRE(x.size() == y.size());
      CHECK(std::equal(x.begin(), x.begin() + measured, y.begin()));
    }
  }
}

TEST_CASE("parts by tag keep what their edges need") {
  for (int seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const Graph graph = graph_of(odd_graph(random));
    graph::Types types{std::vector<bool>(graph.tags.vertices.size(), false),
                       std::vector<bool>(graph.tags.edges.size(), false)};
    for (auto* marks : {&types.vertex, &types.edge}) {
      for (std::size_t k = 0; k < marks->size(); ++k) (*marks)[k] = draw(random, 0, 1) == 0;
    }
    for (const bool kept : {true, false}) {
      const graph::Part part =
          kept ? graph::of_types(graph, types) : graph::without_types(graph, types);
      for (Index e = 0; e < graph.edges(); ++e) {
        const auto ends = graph.edge(e);
        const bool typed = types.edge[graph.edge_type[e]];
        const bool among = std::ranges::all_of(
            ends, [&](Index v) { return types.vertex[graph.vertex_type[v]] == kept; });
        CHECK(part.edge[e] == (kept ? typed || among : !typed && among));
        if (part.edge[e]) CHECK(std::ranges::all_of(ends, [&](Index v) { return part.vertex[v]; }));
      }
      for (Index v = 0; v < graph.vertices(); ++v) {
        bool had = false, has = false;
        for (Index e = 0; e < graph.edges(); ++e) {
          const bool at = std::ranges::count(graph.edge(e), v) > 0;
          had = had || at;
          has = has || (at && part.edge[e]);
        }
        const bool typed = types.vertex[graph.vertex_type[v]];
        const bool bare = graph.role(v) != graph::Role::pose && had && !has;
        CHECK(part.vertex[v] == (kept ? typed || has : !typed && !bare));
      }
    }
  }
}

}  // namespace
