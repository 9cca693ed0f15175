// sg-elim: node elimination step by step, as a table or as a drawing.
#include <algorithm>
#include <set>

#include "cmd/common/drawing.h"
#include "lib/elim/node_elimination.h"
#include "lib/elim/score.h"
#include "lib/text/error.h"

using namespace sg;

namespace {

// Adjacency by bits: 3 GB at this size, where nobody reads the result either.
constexpr Index most_variables = 150'000;

struct Names {
  const Graph& graph;
  const graph::GraphPattern& variables;
  std::string label;  // of the order
  Id operator()(Index j) const { return graph.id[variables.variable_vertex[j]]; }
};

struct Row {
  const Names& id_of;
  const elim::EliminationStep& eliminated;
  std::size_t step;

  const Names& subject() const { return id_of; }
  std::int64_t dim(Index j) const { return id_of.variables.pattern.dim[j]; }
  std::int64_t frontal() const { return dim(eliminated.variable); }
  std::int64_t separator() const {
    std::int64_t sum = 0;
    for (const Index j : eliminated.neighbours) sum += dim(j);
    return sum;
  }
  cmd::IdList neighbours() const {
    cmd::IdList ids;
    for (const Index j : eliminated.neighbours) ids.push_back(id_of(j));
    return ids;
  }
  cmd::IdPairs fill() const {
    cmd::IdPairs pairs;
    for (const auto& [a, b] : eliminated.fill) pairs.emplace_back(id_of(a), id_of(b));
    return pairs;
  }
};

const std::vector<cmd::Column<Row>> columns = cmd::with_subject<Row>({
    {"step", "From 0", &Row::step},
    {"variable", "Id of the variable that goes",
     [](Row& row) { return row.id_of(row.eliminated.variable); }},
    {"neighbours", "Ids of its neighbours in what is left: its separator", &Row::neighbours},
    {"fill", "Edges that are added, as pairs of ids", &Row::fill},
    {"d_f", "Scalar dimension of the variable", &Row::frontal},
    {"d_s", "Scalar dimension of its separator", &Row::separator},
    {"cost", "d_f (d_f + d_s)^2; the sum is the elimination complexity",
     [](Row& row) {
       return elim::elimination_cost(row.frontal(), row.frontal() + row.separator());
     }},
});

using Edge = std::pair<Index, Index>;  // of variables, first < second

Edge edge(Index a, Index b) {
  return {std::min(a, b), std::max(a, b)};
}

// What is left of the graph before a step.
struct EliminationGraph {
  std::vector<Index> nodes;
  std::set<Edge> given;  // edges of the graph itself
  std::set<Edge> fill;   // induced by earlier steps
};

void eliminate(EliminationGraph& left, const elim::EliminationStep& step) {
  std::erase(left.nodes, step.variable);
  const auto touches = [&](const Edge& e) {
    return e.first == step.variable || e.second == step.variable;
  };
  std::erase_if(left.given, touches);
  std::erase_if(left.fill, touches);
  for (const auto& [a, b] : step.fill) left.fill.insert(edge(a, b));
}

// One cluster of the drawing: the variable whose turn it is filled, induced edges dashed.
std::string cluster(std::size_t k, const EliminationGraph& left, Index next, const Names& id_of) {
  const std::string prefix = "g" + std::to_string(k) + "_";
  const auto node = [&](Index j) { return prefix + std::to_string(id_of(j)); };
  std::string text = "  subgraph cluster_" + std::to_string(k) + " {\n    label=\"G(" +
                     std::to_string(k) + ")\";\n";
  for (const Index j : left.nodes) {
    text += "    " + node(j) + " [label=\"" + std::to_string(id_of(j)) + "\"" +
            (j == next ? ", style=filled" : "") + "];\n";
  }
  for (const auto& [a, b] : left.given) text += "    " + node(a) + " -- " + node(b) + ";\n";
  for (const auto& [a, b] : left.fill)
    text += "    " + node(a) + " -- " + node(b) + " [style=dashed];\n";
  return text + "  }\n";
}

void print_dot(const graph::Pattern& pattern, const Names& id_of, const graph::Order& order,
               const std::vector<elim::EliminationStep>& steps, cmd::Output& output) {
  EliminationGraph left{order, {}, {}};
  std::sort(left.nodes.begin(), left.nodes.end());
  for (Index r = 0; r < pattern.rows.size(); ++r) {
    for (const Index a : pattern.rows[r]) {
      for (const Index b : pattern.rows[r]) {
        if (a < b) left.given.emplace(a, b);
      }
    }
  }
  output.write("graph elimination {\n  node [shape=circle];\n");
  for (std::size_t k = 0; k < steps.size(); ++k) {
    output.write(cluster(k, left, steps[k].variable, id_of));
    eliminate(left, steps[k]);
  }
  output.write("}\n");
}

void check_size(const Graph& graph, const graph::Pattern& pattern) {
  if (pattern.variables() <= most_variables) return;
  throw text::input_error(graph.file, 0,
                          std::to_string(pattern.variables()) +
                              " variables are too many to simulate one by one (at most " +
                              std::to_string(most_variables) + "); sg-ec scores any graph");
}

void show(const cmd::Command& command, const cmd::DrawingOptions& options) {
  cmd::check_drawing(command, options);
  cmd::Output output(options.output.path);
  std::optional<cmd::Table<Row>> table;
  if (!options.dot) table.emplace(options.table, columns, cmd::given(options), output);
  cmd::each_elimination(options, [&](const Graph& graph, const cmd::Method& method) {
    cmd::stage("eliminate");
    const graph::GraphPattern variables = graph::graph_pattern(graph);
    const graph::Pattern& pattern = variables.pattern;
    check_size(graph, pattern);
    const graph::Order order = cmd::order_by(method, options.method, graph, variables);
    const auto steps = elim::node_elimination(pattern, order);
    const Names id_of{graph, variables, method.label};
    if (options.dot) return print_dot(pattern, id_of, order, steps, output);
    for (std::size_t k = 0; k < steps.size(); ++k) table->row({id_of, steps[k], k});
  });
  output.commit();
}

void add_options(cmd::Command& command, cmd::DrawingOptions& options) {
  cmd::add_drawing(command, options, "elimination graphs", columns);
}

}  // namespace

int main(int argc, char** argv) {
  return cmd::run(cmd::Command("sg-elim", "Eliminate a graph node by node: neighbours and fill."),
                  argc, argv, add_options, show);
}
