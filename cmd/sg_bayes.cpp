#include <algorithm>

// sg-bayes: the Bayes tree of an elimination, as a table or as a drawing.
#include "cmd/common/command.h"
#include "cmd/common/method.h"
#include "cmd/common/table.h"
#include "lib/elim/bayes_tree.h"

namespace {

const std::vector<std::string_view> columns{"clique",    "parent", "depth", "frontal",
                                            "separator", "d_f",    "d_s",   "cost"};

struct Options {
  sg::Input input;
  sg::MethodOptions method;
  sg::OutputOptions output;
  sg::TableOptions table;
  bool dot = false;
};

// A Bayes tree with the ids of its variables.
struct NamedTree {
  sg::BayesTree tree;
  std::vector<sg::IdList> frontal;
  std::vector<sg::IdList> separator;
};

// In elimination order.
std::vector<sg::IdList> ids(const sg::Lists<>& positions, const sg::Graph& graph,
                            const sg::GraphPattern& variables, const sg::Order& order) {
  std::vector<sg::IdList> result(positions.size());
  for (sg::Index c = 0; c < positions.size(); ++c) {
    std::vector<sg::Index> sorted(positions[c].begin(), positions[c].end());
    std::sort(sorted.begin(), sorted.end());
    for (const sg::Index k : sorted)
      result[c].push_back(graph.id[variables.variable_vertex[order[k]]]);
  }
  return result;
}

NamedTree named_tree(const Options& options, const sg::Graph& graph) {
  const sg::GraphPattern variables = sg::graph_pattern(graph);
  const auto [label, order] = sg::named_order(options.method, graph, variables);
  NamedTree named{sg::bayes_tree(sg::symbolic(variables.pattern, order)), {}, {}};
  named.frontal = ids(sg::clique_frontals(named.tree), graph, variables, order);
  named.separator = ids(sg::clique_separators(sg::ordered(variables.pattern, order), named.tree),
                        graph, variables, order);
  return named;
}

void print_table(const Options& options, const NamedTree& named, sg::Output& output) {
  const sg::BayesTree& tree = named.tree;
  sg::Table table(options.table, columns, output);
  std::vector<std::int64_t> depth(tree.cliques(), 0);
  for (sg::Index c = 0; c < tree.cliques(); ++c) {
    const sg::Index parent = tree.parent[c];
    if (parent >= 0) depth[c] = depth[parent] + 1;
    table.row({std::int64_t{c}, parent < 0 ? sg::Cell() : sg::Cell(std::int64_t{parent}), depth[c],
               named.frontal[c], named.separator[c], tree.frontal_dim[c],
               tree.total_dim[c] - tree.frontal_dim[c],
               sg::elimination_cost(tree.frontal_dim[c], tree.total_dim[c])});
  }
}

std::string joined(const sg::IdList& list) {
  std::string text;
  for (const auto id : list) text += (text.empty() ? "" : " ") + std::to_string(id);
  return text;
}

void print_dot(const NamedTree& named, sg::Output& output) {
  output.write("digraph bayes_tree {\n  node [shape=box, style=rounded];\n");
  for (sg::Index c = 0; c < named.tree.cliques(); ++c) {
    const std::string separator = joined(named.separator[c]);
    output.write("  c" + std::to_string(c) + " [label=\"" + joined(named.frontal[c]) +
                 (separator.empty() ? "" : " : " + separator) + "\"];\n");
    if (named.tree.parent[c] >= 0) {
      output.write("  c" + std::to_string(named.tree.parent[c]) + " -> c" + std::to_string(c) +
                   ";\n");
    }
  }
  output.write("}\n");
}

}  // namespace

int main(int argc, char** argv) {
  sg::Command command("sg-bayes", "Print the Bayes tree of a graph: its cliques.");
  Options options;
  sg::add_input(command, options.input);
  sg::add_method(command, options.method);
  command.app.add_flag("--dot", options.dot, "Draw the tree, for Graphviz");
  sg::add_output(command, options.output);
  sg::add_table(command, options.table, columns);
  return sg::run(command, argc, argv, [&] {
    sg::check(options.method);
    const NamedTree named = named_tree(options, sg::read(options.input));
    sg::Output output(options.output.path);
    if (options.dot) {
      print_dot(named, output);
    } else {
      print_table(options, named, output);
    }
    output.commit();
  });
}
