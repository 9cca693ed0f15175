#include "cmd/bayes/tree.h"

#include <algorithm>

#include "cmd/common/drawing.h"

namespace sg::bayes {

NamedTree named_tree(const cmd::MethodOptions& options, const Graph& graph,
                     const cmd::Method& method) {
  graph::GraphPattern variables = graph::graph_pattern(graph);
  graph::Order order = cmd::order_by(method, options, graph, variables);
  elim::BayesTree tree = elim::bayes_tree(elim::symbolic(variables.pattern, order));
  std::vector<Index> depth(tree.cliques(), 0);
  for (Index c = 0; c < tree.cliques(); ++c) {
    if (tree.parent[c] >= 0) depth[c] = depth[tree.parent[c]] + 1;
  }
  return {graph,           method.label,    std::move(variables), std::move(order),
          std::move(tree), std::move(depth)};
}

namespace {

// The ids of variables at these positions, in elimination order.
cmd::IdList ids(const NamedTree& named, std::span<const Index> positions) {
  std::vector<Index> sorted(positions.begin(), positions.end());
  std::sort(sorted.begin(), sorted.end());
  cmd::IdList result;
  for (const Index k : sorted)
    result.push_back(named.graph.id[named.variables.variable_vertex[named.order[k]]]);
  return result;
}

}  // namespace

cmd::IdList Row::frontal() const {
  return ids(named, named.frontals()[clique]);
}

cmd::IdList Row::separator() const {
  return ids(named, named.separators()[clique]);
}

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

}  // namespace sg::bayes
