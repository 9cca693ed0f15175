// A part of a graph: the selection that kept candidates leave after their sweep, and sparse ones to start from.
#pragma once

#include <span>
#include <vector>

#include "lib/graph/graph.h"
#include "lib/graph/replay.h"

namespace sg::prune {

struct Selection {
  std::vector<bool> vertex, edge;  // whether it is in; an edge that is in has all its vertices in
};

// What may be selected from.
struct Choice {
  const Graph& graph;
  const graph::PoseIndex& poses;
  const std::vector<Index>& candidates;
  Index min_obs = 1;  // observations that a landmark needs to be in
};

// kept: of every candidate, side by side with them.
Selection selection(const Choice& choice, const std::vector<bool>& kept);

// An aligned decimation of the observations (decimate.h) at this rate, none of them at rate 0; no closures but those
// that join parts of the graph. At rate 1, all candidates.
std::vector<bool> sparse_start(const Choice& choice, Index rate);

// Takes the candidates of a landmark out of `kept`; false if it has none left.
bool leave_out(const Choice& choice, Index landmark, std::vector<bool>& kept);

}  // namespace sg::prune
