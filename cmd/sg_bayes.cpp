// sg-bayes: the Bayes tree of an elimination, as a table or as a drawing.
#include <algorithm>

#include "cmd/common/drawing.h"
#include "lib/elim/bayes_tree.h"

using namespace sg;

namespace {

// A Bayes tree with the ids of its variables, which take the space of all cliques together.
struct NamedTree {
  const Graph& graph;
  std::string label;  // of the order
  graph::GraphPattern variables;
  graph::Order order;
  elim::BayesTree tree;
  std::vector<Index> depth;
  std::optional<graph::Lists<>> frontals_ = {};
  std::optional<graph::Lists<>> separators_ = {};

  const graph::Lists<>& frontals() {
    return cmd::once(frontals_, [&] { return elim::clique_frontals(tree); });
  }
  const graph::Lists<>& separators() {
    return cmd::once(separators_, [&] {
      return elim::clique_separators(elim::ordered(variables.pattern, order), tree);
    });
  }
};

NamedTree named_tree(const cmd::DrawingOptions& options, const Graph& graph,
                     const cmd::Method& method) {
  graph::GraphPattern variables = graph::graph_pattern(graph);
  graph::Order order = cmd::order_by(method, options.method, graph, variables);
  elim::BayesTree tree = elim::bayes_tree(elim::symbolic(variables.pattern, order));
  std::vector<Index> depth(tree.cliques(), 0);
  for (Index c = 0; c < tree.cliques(); ++c) {
    if (tree.parent[c] >= 0) depth[c] = depth[tree.parent[c]] + 1;
  }
  return {graph,           method.label,    std::move(variables), std::move(order),
          std::move(tree), std::move(depth)};
}

// The ids of variables at these positions, in elimination order.
cmd::IdList ids(const NamedTree& named, std::span<const Index> positions) {
  std::vector<Index> sorted(positions.begin(), positions.end());
  std::sort(sorted.begin(), sorted.end());
  cmd::IdList result;
  for (const Index k : sorted)
    result.push_back(named.graph.id[named.variables.variable_vertex[named.order[k]]]);
  return result;
}

struct Row {
  NamedTree& named;
  Index clique;

  const NamedTree& subject() const { return named; }
  cmd::IdList frontal() const { return ids(named, named.frontals()[clique]); }
  cmd::IdList separator() const { return ids(named, named.separators()[clique]); }
  std::int64_t frontal_dim() const { return named.tree.frontal_dim[clique]; }
  std::int64_t total_dim() const { return named.tree.total_dim[clique]; }
  std::optional<Index> parent() const {
    const Index above = named.tree.parent[clique];
    return above < 0 ? std::nullopt : std::optional(above);
  }
};

const std::vector<cmd::Column<Row>> columns = cmd::with_subject<Row>({
    {"clique", "Its number, from 0", &Row::clique},
    {"parent", "The clique above; empty at a root", &Row::parent},
    {"depth", "Cliques above it", [](Row& row) { return row.named.depth[row.clique]; }},
    {"frontal", "Ids of the variables eliminated in it, in their order", &Row::frontal},
    {"separator", "Ids of those that they depend on, in their order", &Row::separator},
    {"d_f", "Scalar dimension of its frontal variables", &Row::frontal_dim},
    {"d_s", "Scalar dimension of its separator",
     [](Row& row) { return row.total_dim() - row.frontal_dim(); }},
    {"cost", "d_f (d_f + d_s)^2; the sum is the tree's elimination complexity",
     [](Row& row) { return elim::elimination_cost(row.frontal_dim(), row.total_dim()); }},
});

void print_dot(NamedTree& named, cmd::Output& output) {
  output.write("digraph bayes_tree {\n  node [shape=box, style=rounded];\n");
  for (Index c = 0; c < named.tree.cliques(); ++c) {
    const Row row{named, c};
    const std::string separator = cmd::text(row.separator());
    output.write("  c" + std::to_string(c) + " [label=\"" + cmd::text(row.frontal()) +
                 (separator.empty() ? "" : " : " + separator) + "\"];\n");
    if (row.parent())
      output.write("  c" + std::to_string(*row.parent()) + " -> c" + std::to_string(c) + ";\n");
  }
  output.write("}\n");
}

void show(const cmd::Command& command, const cmd::DrawingOptions& options) {
  cmd::check_drawing(command, options);
  cmd::Output output(options.output.path);
  std::optional<cmd::Table<Row>> table;
  if (!options.dot) table.emplace(options.table, columns, cmd::given(options), output);
  cmd::each_elimination(options, [&](const Graph& graph, const cmd::Method& method) {
    cmd::stage("eliminate");
    NamedTree named = named_tree(options, graph, method);
    if (options.dot) return print_dot(named, output);
    for (Index c = 0; c < named.tree.cliques(); ++c) table->row({named, c});
  });
  output.commit();
}

void add_options(cmd::Command& command, cmd::DrawingOptions& options) {
  cmd::add_drawing(command, options, "tree", columns);
}

}  // namespace

int main(int argc, char** argv) {
  return cmd::run(cmd::Command("sg-bayes", "Print the Bayes tree of a graph: its cliques."), argc,
                  argv, add_options, show);
}
