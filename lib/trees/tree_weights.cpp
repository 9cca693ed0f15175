#include "lib/trees/tree_weights.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "lib/geometry/information.h"
#include "lib/geometry/triangle.h"
#include "lib/text/error.h"

namespace sg::trees {
namespace {

// Where one vertex stands from the other: of an edge between two of them.
const graph::EdgeType& measured_type(const Graph& graph, Index e) {
  const graph::EdgeType& type = graph.type_of_edge(e);
  if (type.arity != 2 || type.counted || graph::facts(type.space).translation.size == 0) {
    throw graph::error_at(
        graph, graph.edge_line[e],
        type.tag + " measures neither translation nor rotation: only unit weights are known");
  }
  return type;
}

// The determinant of these rows and columns of the information, to the power of one over their
// number.
double mean_information(const geometry::SmallMatrix& W, const graph::Axes& axes) {
  const auto block = W.block(axes.first, axes.first, axes.size, axes.size);
  if (axes.size == 0) return 0;
  if (axes.size == 1) return std::max(0.0, block(0, 0));
  if (axes.size == 2) return std::sqrt(std::max(0.0, Eigen::Matrix2d(block).determinant()));
  return std::cbrt(std::max(0.0, Eigen::Matrix3d(block).determinant()));
}

Layer unit_layer(const Graph& graph) {
  Layer layer{1, std::vector<double>(graph.edges(), 0)};
  for (Index e = 0; e < graph.edges(); ++e) layer.weight[e] = graph.edge(e).size() > 1 ? 1 : 0;
  return layer;
}

// Translation and rotation.
std::array<Layer, 2> information_layers(const Graph& graph) {
  std::array<Layer, 2> layers;
  for (Layer& layer : layers) layer.weight.assign(graph.edges(), 0);
  std::vector<double> numbers;
  for (Index e = 0; e < graph.edges(); ++e) {
    if (graph.edge(e).size() < 2) continue;
    const graph::EdgeType& type = measured_type(graph, e);
    const graph::SpaceRow& space = graph::facts(type.space);
    graph::edge_numbers(graph, e, numbers);
    const auto W = geometry::symmetric<geometry::SmallMatrix>(
        std::span(numbers).subspan(type.measurement), type.dim);
    layers[0].weight[e] = mean_information(W, space.translation);
    layers[1].weight[e] = mean_information(W, space.rotation) * space.radian * space.radian;
    layers[0].multiplicity = std::max<double>(layers[0].multiplicity, space.translation.size);
    layers[1].multiplicity = std::max<double>(layers[1].multiplicity, space.rotation.size);
  }
  return layers;
}

}  // namespace

std::optional<Weights> tree_weights(std::string_view name) {
  constexpr std::array<std::string_view, 4> names{"unit", "translation", "rotation", "dopt"};
  const auto it = std::find(names.begin(), names.end(), name);
  if (it == names.end()) return std::nullopt;
  return static_cast<Weights>(it - names.begin());
}

Nodes tree_nodes(const Graph& graph) {
  Nodes nodes{0, std::vector<Index>(graph.vertices(), -1)};
  Index constants = -1;
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (graph.fixed[v] && constants >= 0) {
      nodes.node[v] = constants;
      continue;
    }
    if (graph.fixed[v]) constants = nodes.count;
    nodes.node[v] = nodes.count++;
  }
  return nodes;
}

graph::Lists<Edge> tree_links(const Graph& graph, const Nodes& nodes) {
  graph::Lists<Edge> links;
  for (Index e = 0; e < graph.edges(); ++e) {
    const auto ends = graph.edge(e);
    for (std::size_t k = 1; k < ends.size(); ++k)
      links.items.push_back({nodes.node[ends[0]], nodes.node[ends[k]]});
    links.close();
  }
  return links;
}

std::vector<Layer> tree_layers(const Graph& graph, Weights kind) {
  if (kind == Weights::unit) return {unit_layer(graph)};
  auto [translation, rotation] = information_layers(graph);
  if (kind == Weights::dopt) return {std::move(translation), std::move(rotation)};
  Layer& chosen = kind == Weights::translation ? translation : rotation;
  chosen.multiplicity = 1;
  return {std::move(chosen)};
}

}  // namespace sg::trees
