// Once through all that goes: eliminated in clusters, and what each leaves made sparse.
#pragma once

#include <functional>

#include "lib/graph/pattern.h"
#include "lib/marginalize/clusters.h"
#include "lib/marginalize/prices.h"
#include "lib/marginalize/recover.h"

namespace sg::marginalize {

struct Rule {
  bool linear = false;     // leave linear factors: exact
  Sparsity sparsity = {};  // of what is recovered otherwise
  Clusters clusters = Clusters::online;
  bool conservative = false;  // no piece knows more than it did
};

// What a pass leaves: measurements that say what the estimates say, and owe the gradient; or linear factors.
struct Draft {
  std::vector<bool> edge_gone;  // m
  std::vector<Measurement> measurements;
  std::vector<Piece> linear;
  Eigen::VectorXd owed;   // by scalar of all vertices
  double divergence = 0;  // of Kullback and Leibler, of all recoveries
};

using Progress = std::function<void(Index)>;

// `removed` of every vertex. prices: of topology ec. how: what is recovered, but for what the rule says.
Draft one_pass(const At& at, const std::vector<bool>& removed, const Rule& rule,
               Prices* prices = nullptr, const Progress& progress = {},
               const RecoveryOptions& how = {});

// The vertices of a measurement, ascending.
std::vector<Index> ends_of(const Measurable& of);

// The pattern of what is left: of edges that are not gone, and these measurements.
graph::GraphPattern pattern_left(const Graph& graph, const std::vector<bool>& removed,
                                 const std::vector<bool>& edge_gone, const graph::Lists<>& factors);
graph::Lists<> factors_of(std::span<const Measurement> measurements);

}  // namespace sg::marginalize
