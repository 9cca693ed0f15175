// The cliques that an elimination works through, with their variables.
//
// They are the Bayes tree's of lib/elim, relaxed: a clique joins its parent where one larger front
// takes less time than two and the passage between them (Ashcraft and Grimes, The influence of
// relaxed supernode partitions on the multifrontal method, 1989). EC_BT stays that of the Bayes
// tree itself: every clique carries the sum over those that it was made of.
//
// Cliques stand in postorder, children before parents. Variables are renumbered along with them:
// the items of `frontals` are an elimination order of the same fill as the given one, in which every clique's are
// consecutive.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "lib/graph/pattern.h"

namespace sg::solve {

struct CliqueTree {
  std::vector<Index> parent;       // C, -1 at a root
  graph::Lists<> frontals;         // C, all in elimination order
  graph::Lists<> separators;       // C, each in elimination order
  std::vector<int> frontal_dim;    // C, scalars
  std::vector<int> separator_dim;  // C, scalars
  std::vector<std::int64_t> ec;    // C, its share of EC_BT
  std::vector<Index> merged;       // C: how many cliques of the Bayes tree it is made of
  std::vector<Index> row_clique;   // m: where every row is assembled, -1 for an empty row

  Index cliques() const { return static_cast<Index>(parent.size()); }
};

// Whether each clique of a tree has none below it. parent: -1 at a root.
std::vector<bool> childless(std::span<const Index> parent);

// A clique of fewer rows than `relaxed_from` stays by itself; with `never`, they are the Bayes tree's.
constexpr int never = std::numeric_limits<int>::max();
CliqueTree clique_tree(const graph::Pattern& pattern, const graph::Order& order,
                       int relaxed_from = 0);

// The same before variables are listed, which takes the space of all cliques together: from parents and dimensions of the
// Bayes tree's cliques alone, children before parents.
struct CliqueOutline {
  std::vector<Index>
      target;  // of every clique of the Bayes tree, the one there that it joins; itself where it stays
  std::vector<Index> clique;  // and what that is in `tree`
  CliqueTree tree;            // parents and dimensions alone
};
CliqueOutline clique_outline(std::span<const Index> parent, std::span<const int> frontal_dim,
                             std::span<const int> separator_dim, int relaxed_from = 0);

}  // namespace sg::solve
