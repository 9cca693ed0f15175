// A graph while vertices are taken out of it: the edges that are left, and pieces in the place of those that are gone.
#pragma once

#include <deque>
#include <optional>

#include "lib/graph/lists.h"
#include "lib/marginalize/measurement.h"

namespace sg::marginalize {

// A factor that is no edge of the file's.
struct Made {
  Piece piece;
  std::optional<Measurement>
      measurement;  // none of what is yet to be made sparse, or stays as it is
  bool gone = false;
};

struct Live {
  const At& at;
  graph::Lists<> edges_at;                  // of every vertex
  std::vector<std::vector<Index>> made_at;  // of every vertex; those that are gone among them
  std::vector<int> start;                   // of every vertex in the scalars of all
  Eigen::VectorXd owed;                     // gradient that what is recovered does not have
  std::vector<bool> edge_gone;
  std::deque<Made> made = {};
};

Live live_graph(const At& at);

void add(Live& live, Piece piece, std::optional<Measurement> measurement = {});

// All that stands at v, taken out of the graph and added up.
Piece take(Live& live, Index v);

// The gradient of a piece that will not have it itself.
void owe(Live& live, const Piece& piece);

// How many vertices share a factor with v, v among them.
std::size_t blanket_size(Live& live, Index v);

}  // namespace sg::marginalize
