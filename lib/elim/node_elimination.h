// Node elimination, literally: the elimination graphs of Rose (1972) as Frey, Steiner and How draw
// them in Figure 1.
//
// Eliminating a variable removes it and joins its remaining neighbours pairwise; the edges that
// this adds are fill. Slow and obvious: an adjacency matrix of bits, n^2 / 8 bytes, O(n / 64) work
// for every neighbour met. The fast ways of this folder are tested against it; sg-elim prints it.
#pragma once

#include <utility>
#include <vector>

#include "lib/graph/pattern.h"

namespace sg::elim {

struct EliminationStep {
  Index variable;
  std::vector<Index> neighbours;  // in the elimination graph, by position: its separator
  std::vector<std::pair<Index, Index>> fill;  // edges that the step adds, by position, first the
                                              // end that is eliminated first
};
// A step for every variable, in the order's order. Variables keep their numbers in the pattern.
// Throws std::invalid_argument if `order` is not a permutation of the pattern's variables.
std::vector<EliminationStep> node_elimination(const graph::Pattern& pattern,
                                              const graph::Order& order);

}  // namespace sg::elim
