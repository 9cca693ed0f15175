// sg-diff: what one graph has and another has not: vertices, edges and parameters.
#include <algorithm>
#include <map>

#include "cmd/common/command.h"
#include "cmd/common/options.h"
#include "cmd/common/table.h"
#include "lib/graph/diff.h"
#include "lib/text/words.h"

using namespace sg;

namespace {

struct Options {
  cmd::Inputs inputs;
  cmd::OutputOptions output;
  cmd::TableOptions table;
  double tolerance = 0;
  bool each = false;
};

// Numbers of lines, by where they begin.
std::vector<Offset> line_begins(const Graph& graph) {
  std::vector<Offset> begins;
  for (std::string_view rest = graph.text.view; !rest.empty(); text::next_line(rest))
    begins.push_back(rest.data() - graph.text.view.data());
  return begins;
}

struct Side {
  const Graph& graph;
  std::vector<Offset> begins;

  std::optional<Index> line(Offset at) const {
    if (at == graph::implied) return std::nullopt;
    return static_cast<Index>(std::ranges::upper_bound(begins, at) - begins.begin());
  }
};

// What vertices, edges and parameters are to a table.
struct Kind {
  std::string_view name;
  Index (*count)(const Graph& graph);
  std::string (*tag)(const Graph& graph, Index i);
  std::vector<Id> (*ids)(const Graph& graph, Index i);
  Offset (*at)(const Graph& graph, Index i);
  const std::vector<graph::Difference>& (*of)(const graph::Diff& diff);
};

std::string tag_at(const Graph& graph, Offset line) {
  auto rest = graph::line_at(graph, line);
  return std::string(text::next_word(rest));
}

std::vector<Id> ids_of_edge(const Graph& graph, Index e) {
  std::vector<Id> ids;
  for (const Index v : graph.edge(e)) ids.push_back(graph.id[v]);
  return ids;
}

const std::array kinds{Kind{"vertex", [](const Graph& g) { return g.vertices(); },
                            [](const Graph& g, Index v) { return g.type_of_vertex(v).tag; },
                            [](const Graph& g, Index v) { return std::vector{g.id[v]}; },
                            [](const Graph& g, Index v) { return g.vertex_line[v]; },
                            [](const graph::Diff& d) -> const auto& {return d.vertices;
}  // namespace
}
, Kind{"edge", [](const Graph& g) { return g.edges(); },
       [](const Graph& g, Index e) { return g.type_of_edge(e).tag; }, ids_of_edge,
       [](const Graph& g, Index e) { return g.edge_line[e]; },
       [](const graph::Diff& d) -> const auto& {return d.edges;
}
}
, Kind {
  "parameter", [](const Graph& g) { return static_cast<Index>(g.params.size()); },
      [](const Graph& g, Index p) { return tag_at(g, g.params[p].line); },
      [](const Graph& g, Index p) { return std::vector{g.params[p].id}; },
      [](const Graph& g, Index p) { return g.params[p].line; },
      [](const graph::Diff& d) -> const auto& {
    return d.params;
  }
}
}
;

// ---- A row a tag.

struct Count {
  std::string_view kind;
  std::string tag;
  Index a = 0, b = 0, only_a = 0, only_b = 0, changed = 0;
};

const std::vector<cmd::Column<Count>> count_columns{
    {"kind", "vertex, edge or parameter", &Count::kind},
    {"tag", "Its tag", &Count::tag},
    {"a", "Lines that A has", &Count::a},
    {"b", "Lines that B has", &Count::b},
    {"only_a", "Lines that only A has", &Count::only_a},
    {"only_b", "Lines that only B has", &Count::only_b},
    {"changed", "Lines that both have, with other numbers", &Count::changed}};

std::vector<Count> counts(const Kind& kind, const Graph& a, const Graph& b,
                          const graph::Diff& diff) {
  std::map<std::string, Count> by_tag;
  const auto count = [&](const Graph& graph, Index i) -> Count& {
    const std::string tag = kind.tag(graph, i);
    return by_tag.try_emplace(tag, Count{kind.name, tag}).first->second;
  };
  for (Index i = 0; i < kind.count(a); ++i) ++count(a, i).a;
  for (Index i = 0; i < kind.count(b); ++i) ++count(b, i).b;
  for (const auto& [i, j, by] : kind.of(diff)) {
    if (i < 0) {
      ++count(b, j).only_b;
    } else {
      ++(j < 0 ? count(a, i).only_a : count(a, i).changed);
    }
  }
  std::vector<Count> rows;
  for (auto& [tag, row] : by_tag) rows.push_back(std::move(row));
  return rows;
}

// ---- A row a difference.

struct Row {
  std::string_view where, kind;
  std::string tag;
  std::vector<Id> ids;
  std::optional<Index> line_a, line_b;
  std::optional<double> by;
};

const std::vector<cmd::Column<Row>> each_columns{
    {"where", "a: only A has it; b: only B has it; both: it is changed", &Row::where},
    {"kind", "vertex, edge or parameter", &Row::kind},
    {"tag", "Its tag", &Row::tag},
    {"ids", "Its id, or those of the vertices that the edge joins", &Row::ids},
    {"line_a", "Its line in A", &Row::line_a},
    {"line_b", "Its line in B", &Row::line_b},
    {"by", "The largest change of a number, relative to what is above 1", &Row::by}};

Row row(const Kind& kind, const Side& a, const Side& b, const graph::Difference& difference) {
  const auto [i, j, by] = difference;
  const Graph& graph = i < 0 ? b.graph : a.graph;
  const Index k = i < 0 ? j : i;
  return {i < 0   ? "b"
          : j < 0 ? "a"
                  : "both",
          kind.name,
          kind.tag(graph, k),
          kind.ids(graph, k),
          i < 0 ? std::nullopt : a.line(kind.at(a.graph, i)),
          j < 0 ? std::nullopt : b.line(kind.at(b.graph, j)),
          by};
}

// "3 vertices, 15 edges"
std::string counted(const std::array<Index, 3>& count) {
  constexpr std::array<std::string_view, 3> one{"vertex", "edge", "parameter"},
      many{"vertices", "edges", "parameters"};
  std::string said;
  for (std::size_t k = 0; k < count.size(); ++k) {
    if (count[k] == 0) continue;
    said += (said.empty() ? "" : ", ") + std::to_string(count[k]) + " " +
            std::string(count[k] == 1 ? one[k] : many[k]);
  }
  return said.empty() ? "nothing" : said;
}

std::string summary(const Graph& a, const Graph& b, const graph::Diff& diff) {
  std::array<Index, 3> only_a{}, only_b{}, changed{};
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    for (const auto& [i, j, by] : kinds[k].of(diff))
      ++(j < 0 ? only_a : i < 0 ? only_b : changed)[k];
  }
  return "only in " + a.file + ": " + counted(only_a) + "; only in " + b.file + ": " +
         counted(only_b) + "; changed: " + counted(changed);
}

bool any(const graph::Diff& diff) {
  return std::ranges::any_of(kinds, [&](const Kind& kind) { return !kind.of(diff).empty(); });
}

int compare(const cmd::Command& command, const Options& options) {
  auto paths = options.inputs.paths;
  if (paths.size() == 1) paths.emplace_back("-");
  if (paths.size() != 2 || (paths[0] == "-" && paths[1] == "-"))
    throw text::usage_error(
        "two graphs are compared: give A and B, one of them - for standard input");
  cmd::check_form(command.app);
  cmd::Output output(options.output.path);
  std::optional<cmd::Table<Count>> by_tag;
  std::optional<cmd::Table<Row>> each;
  if (options.each) {
    each.emplace(options.table, each_columns, cmd::Given{}, output);
  } else {
    by_tag.emplace(options.table, count_columns, cmd::Given{}, output);
  }
  // Standard input first: where it is closed, its number would be that of the next file.
  std::optional<Graph> piped;
  if (paths[1] == "-") piped = cmd::read(options.inputs, paths[1]);
  const Graph a = cmd::read(options.inputs, paths[0]);
  const Graph b = piped ? std::move(*piped) : cmd::read(options.inputs, paths[1]);
  cmd::stage("compare");
  const graph::Diff diff = graph::diff(a, b, options.tolerance);
  if (each) {
    const Side side_a{a, line_begins(a)}, side_b{b, line_begins(b)};
    for (const Kind& kind : kinds) {
      for (const auto& difference : kind.of(diff)) each->row(row(kind, side_a, side_b, difference));
    }
  } else {
    for (const Kind& kind : kinds) {
      for (const Count& count : counts(kind, a, b, diff)) by_tag->row(count);
    }
  }
  output.commit();
  if (!any(diff)) return 0;
  cmd::warn(command, summary(a, b, diff));
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  cmd::Command command("sg-diff", "Compare two graphs A and B: a row a tag.");
  Options options;
  cmd::add_inputs(command, options.inputs);
  command.app.add_flag("--each", options.each, "A row for everything that differs");
  command.app
      .add_option(
          "--tolerance", options.tolerance,
          "Numbers differ where they are more than X apart,\nor X of their size (default: 0)")
      ->transform(cmd::number())
      ->option_text("X");
  cmd::add_output(command, options.output);
  cmd::add_table(
      command, options.table,
      {{"", cmd::headings(count_columns)}, {"With --each:", cmd::headings(each_columns)}});
  return cmd::run_status(command, argc, argv, [&] { return compare(command, options); });
}
