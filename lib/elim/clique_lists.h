// The Bayes tree with its separators, in one pass over the variables.
//
// A variable's separator is what its rows and the cliques that wait for it name, itself apart; a clique waits for the
// first variable of its separator. Where the longest of these separators names all of it, the variable joins that clique
// and takes its list over, less one; otherwise it opens a clique, with a list of its own. So a list is written once a
// clique, and looked through once a variable. It is bayes_tree.h's tree: of several children that would do, the variable
// joins the last. For who wants the lists; who wants dimensions alone takes less space by counts.h.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lib/graph/pattern.h"

namespace sg::elim {

struct CliqueLists {
  // Cliques ascend by their last position, and so children come before their parents.
  std::vector<Index> clique;       // of every position
  std::vector<Index> parent;       // of every clique, -1 at a root
  std::vector<int> frontal_dim;    // scalars
  std::vector<int> separator_dim;  // scalars
  std::vector<Index> row_first;    // by row of the pattern: its first position, -1 of an empty one

  std::vector<Index> separator_begin, separator_end;  // of every clique, into items
  std::vector<Index> items;                           // positions, ascending in a separator

  Index cliques() const { return static_cast<Index>(parent.size()); }
  std::span<const Index> separator(Index c) const {
    return std::span(items).subspan(separator_begin[c], separator_end[c] - separator_begin[c]);
  }
};

// Throws std::invalid_argument if `order` is no permutation of the pattern's variables.
CliqueLists clique_lists(const graph::Pattern& pattern, const graph::Order& order);

}  // namespace sg::elim
