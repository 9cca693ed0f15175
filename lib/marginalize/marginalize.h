// Vertices out of a graph, and what their edges knew kept: as factors among the vertices that were their neighbours.
//
// The edges of what goes are linearized at the estimates; eliminating it (piece.h) leaves the exact Gaussian of its
// Markov blanket, which is either kept as it is, as one linear factor, or given to ordinary edges on a sparse topology
// (topology.h, prices.h) with the informations nearest to it (recover.h). What is recovered counts as an edge when a
// neighbour goes in its turn. It says what the estimates say, and owes the gradient, until all is recovered (errors.h).
#pragma once

#include <string>

#include "lib/marginalize/pass.h"

namespace sg::marginalize {

struct Marginalization {
  std::vector<bool> vertex, edge;  // n, m: what goes
  std::string lines;               // what comes, each with its newline
  graph::Lists<> factors;          // the vertices of every edge among them
  double divergence = 0;           // of Kullback and Leibler, of all recoveries
};
// The pattern of what is left.
graph::GraphPattern pattern_left(const Graph& graph, const Marginalization& result);

// `removed` of every vertex; none is fixed. `progress` is told how many are gone. Throws an input Error at the line of
// an edge whose vertex cannot be taken out, since no measurement of g2o's could tell of a neighbour; before anything is
// computed, but where that depends on what has been recovered.
Marginalization marginalize(const At& at, const std::vector<bool>& removed, const Rule& rule,
                            const Progress& progress = {});

}  // namespace sg::marginalize
