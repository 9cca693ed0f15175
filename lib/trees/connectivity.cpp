#include "lib/trees/connectivity.h"

#include <Spectra/SymEigsSolver.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

#include "lib/text/error.h"
#include "lib/trees/spanning_trees.h"

namespace sg::trees {
namespace {

// The nodes and links of one layer, nodes renumbered.
struct LayerGraph {
  Index nodes = 0;
  std::vector<TreeEdge> links;
  std::vector<double> weight;
};

// Nodes without a link are left out where others have some: but not under unit weights, where every
// node could have one, and its lack of it is a lack of the graph.
LayerGraph layer_graph(const graph::Lists<TreeEdge>& links, Index nodes, const TreeLayer& layer,
                       bool keep_isolated) {
  LayerGraph result;
  std::vector<Index> number(nodes, keep_isolated ? 0 : -1);
  for (Index e = 0; e < links.size(); ++e) {
    if (!(layer.weight[e] > 0)) continue;
    for (const TreeEdge& link : links[e]) {
      if (link.u == link.v) continue;
      number[link.u] = number[link.v] = 0;
      result.links.push_back(link);
      result.weight.push_back(layer.weight[e]);
    }
  }
  for (Index& n : number) {
    if (n == 0) n = result.nodes++;
  }
  for (TreeEdge& link : result.links) link = {number[link.u], number[link.v]};
  return result;
}

std::vector<LayerGraph> layer_graphs(const Graph& graph, TreeWeights kind,
                                     std::vector<double>& multiplicity) {
  const TreeNodes nodes = tree_nodes(graph);
  const graph::Lists<TreeEdge> links = tree_links(graph, nodes);
  std::vector<LayerGraph> graphs;
  for (const TreeLayer& layer : tree_layers(graph, kind)) {
    const bool all = kind != TreeWeights::rotation && graphs.empty();  // landmarks do not rotate
    graphs.push_back(layer_graph(links, nodes.count, layer, all));
    multiplicity.push_back(layer.multiplicity);
  }
  return graphs;
}

bool connected(SpanningTrees& trees) {
  Index roots = 0;
  for (std::size_t v = 0; v < trees.part.size(); ++v) {
    roots += trees.part[v] == static_cast<Index>(v);
  }
  return roots <= 1;
}

// x -> L^+ x. For x without mean, M y = x with the grounded M = L + e_g e_g^T gives y_g = 0, so
// that L y = x; the pseudo-inverse has no mean itself.
struct PseudoInverse {
  using Scalar = double;
  SpanningTrees& trees;

  Eigen::Index rows() const { return static_cast<Eigen::Index>(trees.position.size()); }
  Eigen::Index cols() const { return rows(); }
  void perform_op(const double* in, double* out) const {
    const Eigen::Map<const Eigen::VectorXd> x(in, rows());
    Eigen::Map<Eigen::VectorXd> y(out, rows());
    y.array() = x.array() - x.mean();
    solve(trees, {out, static_cast<std::size_t>(rows())});
    y.array() -= y.mean();
  }
};

double dense_connectivity(const LayerGraph& graph) {
  Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(graph.nodes, graph.nodes);
  for (std::size_t k = 0; k < graph.links.size(); ++k) {
    const auto [u, v] = graph.links[k];
    laplacian(u, u) += graph.weight[k], laplacian(v, v) += graph.weight[k];
    laplacian(u, v) -= graph.weight[k], laplacian(v, u) -= graph.weight[k];
  }
  using Solver = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;
  return Solver(laplacian, Eigen::EigenvaluesOnly).eigenvalues()[1];
}

constexpr Index dense_limit = 64;
constexpr int krylov_dimension = 40;
constexpr int restarts = 1000;
constexpr double tolerance = 1e-10;

double sparse_connectivity(SpanningTrees& trees) {
  PseudoInverse inverse{trees};
  Spectra::SymEigsSolver<PseudoInverse> solver(inverse, 1, krylov_dimension);
  solver.init();
  solver.compute(Spectra::SortRule::LargestAlge, restarts, tolerance);
  if (solver.info() != Spectra::CompInfo::Successful)
    throw text::computation_error("the iteration for the algebraic connectivity does not converge");
  return 1 / solver.eigenvalues()[0];
}

}  // namespace

double log_trees(const Graph& graph, TreeWeights weights) {
  std::vector<double> multiplicity;
  double sum = 0;
  const auto graphs = layer_graphs(graph, weights, multiplicity);
  for (std::size_t k = 0; k < graphs.size(); ++k) {
    SpanningTrees trees = spanning_trees(graphs[k].nodes, graphs[k].links, graphs[k].weight);
    if (!connected(trees)) return -std::numeric_limits<double>::infinity();
    sum += multiplicity[k] * trees.log_trees;
  }
  return sum;
}

std::optional<double> algebraic_connectivity(const Graph& graph, TreeWeights weights) {
  if (weights == TreeWeights::dopt) return std::nullopt;
  std::vector<double> multiplicity;
  const LayerGraph layer = layer_graphs(graph, weights, multiplicity)[0];
  if (layer.nodes < 2) return std::nullopt;
  SpanningTrees trees = spanning_trees(layer.nodes, layer.links, layer.weight);
  if (!connected(trees)) return 0;
  return layer.nodes <= dense_limit ? dense_connectivity(layer) : sparse_connectivity(trees);
}

}  // namespace sg::trees
