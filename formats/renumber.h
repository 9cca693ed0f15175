// Other ids for the vertices and parameters of a graph, in its text: every word that names one is replaced, and nothing
// else is touched.
#pragma once

#include <map>
#include <set>
#include <vector>

#include "formats/write.h"

namespace sg::formats {

struct NewIds {
  std::vector<Id> vertex;       // n, by vertex
  std::map<Id, Id> params;      // of those that change
  std::set<Id> dropped_params;  // whose lines go; edges name the new id
};
// Its own ids.
NewIds same_ids(const Graph& graph);
// Poses 0, 1, 2, ... and all others behind them, both in the order of their ids: a pose keeps its index.
NewIds counted_ids(const Graph& graph);

// The graph must outlive the changes. It has no lines that reading left out (Graph::left_out).
Changes renumbered(const Graph& graph, NewIds ids);

}  // namespace sg::formats
