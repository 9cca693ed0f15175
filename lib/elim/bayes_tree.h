// The Bayes tree of an elimination (Kaess et al., iSAM2, IJRR 2012, algorithm 2), symbolic part.
//
// Conditionals are taken in reverse elimination order. Conditional i joins the clique of its parent
// p in the elimination tree when its separator is p and all of p's separator, and no other child
// joined on top of p before; otherwise it opens a clique below. The separator of i always lies
// within {p} and p's separator, so equal dimensions mean equal sets.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/elim/score.h"
#include "lib/graph/lists.h"

namespace sg::elim {

struct BayesTree {
  std::vector<Index> clique;  // of every position
  std::vector<Index> parent;  // of every clique, -1 at a root; parents come before their children
  std::vector<Index> top;     // last eliminated position of every clique
  std::vector<std::int64_t> frontal_dim;  // d_f of every clique
  std::vector<std::int64_t> total_dim;    // d_f + d_s of every clique
  Index cliques() const { return static_cast<Index>(parent.size()); }
};
BayesTree bayes_tree(const Symbolic& symbolic);
// EC_BT: the sum over cliques of d_f (d_f + d_s)^2.
Wide elimination_complexity(const BayesTree& tree);

// The positions of every clique's frontal variables, ascending.
graph::Lists<> clique_frontals(const BayesTree& tree);
// The positions of every clique's separator, in no order. Unlike the dimensions above they take the
// space of all cliques together.
graph::Lists<> clique_separators(const OrderedPattern& pattern, const BayesTree& tree);

}  // namespace sg::elim
