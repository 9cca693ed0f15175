#include "lib/trees/tree_weights.h"

#include <algorithm>
#include <array>
#include <cmath>

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
double mean_information(const graph::EdgeType& type, const graph::Axes& axes,
                        const std::vector<double>& numbers) {
  const auto w = [&](int i, int j) {
    i += axes.first, j += axes.first;
    if (i > j) std::swap(i, j);
    return numbers[type.measurement + i * type.dim - i * (i - 1) / 2 + (j - i)];
  };
  if (axes.size == 0) return 0;
  if (axes.size == 1) return std::max(0.0, w(0, 0));
  if (axes.size == 2) return std::sqrt(std::max(0.0, w(0, 0) * w(1, 1) - w(0, 1) * w(0, 1)));
  const double det = w(0, 0) * (w(1, 1) * w(2, 2) - w(1, 2) * w(1, 2)) -
                     w(0, 1) * (w(0, 1) * w(2, 2) - w(1, 2) * w(0, 2)) +
                     w(0, 2) * (w(0, 1) * w(1, 2) - w(1, 1) * w(0, 2));
  return std::cbrt(std::max(0.0, det));
}

TreeLayer unit_layer(const Graph& graph) {
  TreeLayer layer{1, std::vector<double>(graph.edges(), 0)};
  for (Index e = 0; e < graph.edges(); ++e) layer.weight[e] = graph.edge(e).size() > 1 ? 1 : 0;
  return layer;
}

// Translation and rotation.
std::array<TreeLayer, 2> information_layers(const Graph& graph) {
  std::array<TreeLayer, 2> layers;
  for (TreeLayer& layer : layers) layer.weight.assign(graph.edges(), 0);
  std::vector<double> numbers;
  for (Index e = 0; e < graph.edges(); ++e) {
    if (graph.edge(e).size() < 2) continue;
    const graph::EdgeType& type = measured_type(graph, e);
    const graph::SpaceRow& space = graph::facts(type.space);
    graph::edge_numbers(graph, e, numbers);
    layers[0].weight[e] = mean_information(type, space.translation, numbers);
    layers[1].weight[e] =
        mean_information(type, space.rotation, numbers) * space.radian * space.radian;
    layers[0].multiplicity = std::max<double>(layers[0].multiplicity, space.translation.size);
    layers[1].multiplicity = std::max<double>(layers[1].multiplicity, space.rotation.size);
  }
  return layers;
}

}  // namespace

std::optional<TreeWeights> tree_weights(std::string_view name) {
  constexpr std::array<std::string_view, 4> names{"unit", "translation", "rotation", "dopt"};
  const auto it = std::find(names.begin(), names.end(), name);
  if (it == names.end()) return std::nullopt;
  return static_cast<TreeWeights>(it - names.begin());
}

TreeNodes tree_nodes(const Graph& graph) {
  TreeNodes nodes{0, std::vector<Index>(graph.vertices(), -1)};
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

graph::Lists<TreeEdge> tree_links(const Graph& graph, const TreeNodes& nodes) {
  graph::Lists<TreeEdge> links;
  for (Index e = 0; e < graph.edges(); ++e) {
    const auto ends = graph.edge(e);
    for (std::size_t k = 1; k < ends.size(); ++k)
      links.items.push_back({nodes.node[ends[0]], nodes.node[ends[k]]});
    links.close();
  }
  return links;
}

std::vector<TreeLayer> tree_layers(const Graph& graph, TreeWeights kind) {
  if (kind == TreeWeights::unit) return {unit_layer(graph)};
  auto [translation, rotation] = information_layers(graph);
  if (kind == TreeWeights::dopt) return {std::move(translation), std::move(rotation)};
  TreeLayer& chosen = kind == TreeWeights::translation ? translation : rotation;
  chosen.multiplicity = 1;
  return {std::move(chosen)};
}

}  // namespace sg::trees
