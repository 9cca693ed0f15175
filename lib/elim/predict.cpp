#include "lib/elim/predict.h"

#include <algorithm>

#include "lib/graph/summary.h"

namespace sg::elim {

Sizes sizes(const Graph& graph) {
  Sizes sizes;
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (graph.fixed[v]) continue;
    if (graph.role(v) == graph::Role::pose) sizes.poses += graph.dim(v);
    if (graph.role(v) == graph::Role::landmark) sizes.landmarks += graph.dim(v);
  }
  return sizes;
}

double sighted(const Graph& graph) {
  const auto poses = std::ranges::count_if(graph.vertex_type, [&](graph::TypeIndex t) {
    return graph.tags.vertices[t].role == graph::Role::pose;
  });
  return poses == 0 ? 0
                    : graph::average_observations(graph).value_or(0) / static_cast<double>(poses);
}

double predict_full(const Sizes& sizes) {
  return predict_keyframes(sizes, 1);
}

double predict_keyframes(const Sizes& sizes, double rate) {
  const double kept = sizes.poses / rate;
  return (sizes.landmarks + kept) * kept * kept;
}

double predict_decimation(const Sizes& sizes, double rate) {
  const double part = sizes.poses / rate;
  return (sizes.landmarks + 9 * sizes.poses) * part * part;
}

}  // namespace sg::elim
