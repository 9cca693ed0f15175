// sg-bayes: the Bayes tree of an elimination, as a table or as a drawing.
#include <algorithm>

#include "cmd/common/drawing.h"
#include "lib/elim/bayes_tree.h"

namespace {

// A Bayes tree with the ids of its variables, which take the space of all cliques together.
struct NamedTree {
  const sg::Graph& graph;
  sg::GraphPattern variables;
  sg::Order order;
  sg::BayesTree tree;
  std::vector<sg::Index> depth;
  std::optional<sg::Lists<>> frontals_ = {};
  std::optional<sg::Lists<>> separators_ = {};

  const sg::Lists<>& frontals() {
    return sg::once(frontals_, [&] { return sg::clique_frontals(tree); });
  }
  const sg::Lists<>& separators() {
    return sg::once(separators_, [&] {
      return sg::clique_separators(sg::ordered(variables.pattern, order), tree);
    });
  }
};

NamedTree named_tree(const sg::DrawingOptions& options, const sg::Graph& graph) {
  sg::GraphPattern variables = sg::graph_pattern(graph);
  sg::Order order = sg::named_order(options.method, graph, variables).order;
  sg::BayesTree tree = sg::bayes_tree(sg::symbolic(variables.pattern, order));
  std::vector<sg::Index> depth(tree.cliques(), 0);
  for (sg::Index c = 0; c < tree.cliques(); ++c) {
    if (tree.parent[c] >= 0) depth[c] = depth[tree.parent[c]] + 1;
  }
  return {graph, std::move(variables), std::move(order), std::move(tree), std::move(depth)};
}

// The ids of variables at these positions, in elimination order.
sg::IdList ids(const NamedTree& named, std::span<const sg::Index> positions) {
  std::vector<sg::Index> sorted(positions.begin(), positions.end());
  std::sort(sorted.begin(), sorted.end());
  sg::IdList result;
  for (const sg::Index k : sorted)
    result.push_back(named.graph.id[named.variables.variable_vertex[named.order[k]]]);
  return result;
}

struct Row {
  NamedTree& named;
  sg::Index clique;

  sg::IdList frontal() const { return ids(named, named.frontals()[clique]); }
  sg::IdList separator() const { return ids(named, named.separators()[clique]); }
  std::int64_t frontal_dim() const { return named.tree.frontal_dim[clique]; }
  std::int64_t total_dim() const { return named.tree.total_dim[clique]; }
  std::optional<sg::Index> parent() const {
    const sg::Index above = named.tree.parent[clique];
    return above < 0 ? std::nullopt : std::optional(above);
  }
};

const std::vector<sg::Column<Row>> columns{
    {"clique", "Its number, from 0", &Row::clique},
    {"parent", "The clique above; empty at a root", &Row::parent},
    {"depth", "Cliques above it", [](Row& row) { return row.named.depth[row.clique]; }},
    {"frontal", "Ids of the variables eliminated in it, in their order", &Row::frontal},
    {"separator", "Ids of those that they depend on, in their order", &Row::separator},
    {"d_f", "Scalar dimension of its frontal variables", &Row::frontal_dim},
    {"d_s", "Scalar dimension of its separator",
     [](Row& row) { return row.total_dim() - row.frontal_dim(); }},
    {"cost", "d_f (d_f + d_s)^2; the sum is the tree's elimination complexity",
     [](Row& row) { return sg::elimination_cost(row.frontal_dim(), row.total_dim()); }},
};

void print_dot(NamedTree& named, sg::Output& output) {
  output.write("digraph bayes_tree {\n  node [shape=box, style=rounded];\n");
  for (sg::Index c = 0; c < named.tree.cliques(); ++c) {
    const Row row{named, c};
    const std::string separator = sg::text(row.separator());
    output.write("  c" + std::to_string(c) + " [label=\"" + sg::text(row.frontal()) +
                 (separator.empty() ? "" : " : " + separator) + "\"];\n");
    if (row.parent())
      output.write("  c" + std::to_string(*row.parent()) + " -> c" + std::to_string(c) + ";\n");
  }
  output.write("}\n");
}

void show(const sg::Command& /*command*/, const sg::DrawingOptions& options) {
  sg::check(options.method);
  const sg::Graph graph = sg::read(options.input);
  NamedTree named = named_tree(options, graph);
  sg::Output output(options.output.path);
  if (options.dot) {
    print_dot(named, output);
  } else {
    sg::Table table(options.table, columns, {}, output);
    for (sg::Index c = 0; c < named.tree.cliques(); ++c) table.row({named, c});
  }
  output.commit();
}

void add_options(sg::Command& command, sg::DrawingOptions& options) {
  sg::add_drawing(command, options, "tree", columns);
}

}  // namespace

int main(int argc, char** argv) {
  return sg::run(sg::Command("sg-bayes", "Print the Bayes tree of a graph: its cliques."), argc,
                 argv, add_options, show);
}
