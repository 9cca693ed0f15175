// sg-elim: node elimination step by step, as a table or as a drawing.
#include <algorithm>
#include <set>

#include "cmd/common/command.h"
#include "cmd/common/method.h"
#include "cmd/common/table.h"
#include "lib/elim/node_elimination.h"
#include "lib/elim/score.h"
#include "lib/text/error.h"

namespace {

// Adjacency by bits: 3 GB at this size, where nobody reads the result either.
constexpr sg::Index most_variables = 150'000;

const std::vector<std::string_view> columns{"step", "variable", "neighbours", "fill",
                                            "d_f",  "d_s",      "cost"};

struct Options {
  sg::Input input;
  sg::MethodOptions method;
  sg::OutputOptions output;
  sg::TableOptions table;
  bool dot = false;
};

using Edge = std::pair<sg::Index, sg::Index>;  // of variables, first < second

Edge edge(sg::Index a, sg::Index b) {
  return {std::min(a, b), std::max(a, b)};
}

struct Names {
  const sg::Graph& graph;
  const sg::GraphPattern& variables;
  sg::Id operator()(sg::Index j) const { return graph.id[variables.variable_vertex[j]]; }
};

sg::IdPairs id_pairs(const std::vector<Edge>& edges, const Names& id_of) {
  sg::IdPairs pairs;
  for (const auto& [a, b] : edges) pairs.emplace_back(id_of(a), id_of(b));
  return pairs;
}

void print_table(const Options& options, const sg::Pattern& pattern, const Names& id_of,
                 const std::vector<sg::EliminationStep>& steps, sg::Output& output) {
  sg::Table table(options.table, columns, output);
  std::int64_t k = 0;
  for (const auto& step : steps) {
    sg::IdList neighbours;
    std::int64_t separator = 0;
    for (const sg::Index j : step.neighbours) {
      neighbours.push_back(id_of(j));
      separator += pattern.dim[j];
    }
    const std::int64_t frontal = pattern.dim[step.variable];
    table.row({k++, id_of(step.variable), neighbours, id_pairs(step.fill, id_of), frontal,
               separator, sg::elimination_cost(frontal, frontal + separator)});
  }
}

// What is left of the graph before a step.
struct EliminationGraph {
  std::vector<sg::Index> nodes;
  std::set<Edge> given;  // edges of the graph itself
  std::set<Edge> fill;   // induced by earlier steps
};

void eliminate(EliminationGraph& left, const sg::EliminationStep& step) {
  std::erase(left.nodes, step.variable);
  const auto touches = [&](const Edge& e) {
    return e.first == step.variable || e.second == step.variable;
  };
  std::erase_if(left.given, touches);
  std::erase_if(left.fill, touches);
  for (const auto& [a, b] : step.fill) left.fill.insert(edge(a, b));
}

// One cluster of the drawing: the variable whose turn it is filled, induced edges dashed.
std::string cluster(std::size_t k, const EliminationGraph& left, sg::Index next,
                    const Names& id_of) {
  const std::string prefix = "g" + std::to_string(k) + "_";
  const auto node = [&](sg::Index j) { return prefix + std::to_string(id_of(j)); };
  std::string text = "  subgraph cluster_" + std::to_string(k) + " {\n    label=\"G(" +
                     std::to_string(k) + ")\";\n";
  for (const sg::Index j : left.nodes) {
    text += "    " + node(j) + " [label=\"" + std::to_string(id_of(j)) + "\"" +
            (j == next ? ", style=filled" : "") + "];\n";
  }
  for (const auto& [a, b] : left.given) text += "    " + node(a) + " -- " + node(b) + ";\n";
  for (const auto& [a, b] : left.fill)
    text += "    " + node(a) + " -- " + node(b) + " [style=dashed];\n";
  return text + "  }\n";
}

void print_dot(const sg::Pattern& pattern, const Names& id_of, const sg::Order& order,
               const std::vector<sg::EliminationStep>& steps, sg::Output& output) {
  EliminationGraph left{order, {}, {}};
  std::sort(left.nodes.begin(), left.nodes.end());
  for (sg::Index r = 0; r < pattern.rows(); ++r) {
    for (const sg::Index a : pattern.row(r)) {
      for (const sg::Index b : pattern.row(r)) {
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

void simulate(const Options& options) {
  const sg::Graph graph = sg::read(options.input);
  const sg::GraphPattern variables = sg::graph_pattern(graph);
  const sg::Pattern& pattern = variables.pattern;
  if (pattern.variables() > most_variables) {
    throw sg::input_error(graph.file, 0,
                          std::to_string(pattern.variables()) +
                              " variables are too many to simulate one by one (at most " +
                              std::to_string(most_variables) + "); sg-ec scores any graph");
  }
  const auto [label, order] = sg::named_order(options.method, graph, variables);
  const auto steps = sg::node_elimination(pattern, order);
  const Names id_of{graph, variables};
  sg::Output output(options.output.path);
  if (options.dot) {
    print_dot(pattern, id_of, order, steps, output);
  } else {
    print_table(options, pattern, id_of, steps, output);
  }
  output.commit();
}

}  // namespace

int main(int argc, char** argv) {
  sg::Command command("sg-elim", "Eliminate a graph node by node: neighbours and fill.");
  Options options;
  sg::add_input(command, options.input);
  sg::add_method(command, options.method);
  command.app.add_flag("--dot", options.dot, "Draw the elimination graphs, for Graphviz");
  sg::add_output(command, options.output);
  sg::add_table(command, options.table, columns);
  return sg::run(command, argc, argv, [&] {
    sg::check(options.method);
    simulate(options);
  });
}
