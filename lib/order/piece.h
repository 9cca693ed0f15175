// A piece of a graph: what nested dissection has still to order, and what is around it.
//
// Its *inner* vertices are to be ordered. The *outer* ones, their neighbours, are in separators that are eliminated
// later. Eliminating the inner ones costs the same whatever happens elsewhere: by their turn, all else around has
// either gone or is outer.
#pragma once

#include <vector>

#include "lib/graph/lists.h"

namespace sg::order {

struct Piece {
  std::vector<Index> inner, outer;  // as the graph calls them
  std::vector<int> inner_weight, outer_weight;
  graph::Lists<> inside;  // of every inner vertex its inner neighbours, by their place in `inner`
  graph::Lists<> around;  // and its outer ones, by their place in `outer`

  Index size() const { return inside.size(); }
  std::size_t entries() const { return inside.items.size() + around.items.size(); }
};

// The piece of these inner vertices and all their other neighbours. number: scratch space of n zeros, left as such.
Piece piece(const graph::Lists<>& adjacency, const std::vector<int>& weight,
            std::vector<Index> inner, std::vector<Index>& number);

// The piece's graph and what is around it, which comes last.
graph::Lists<> with_outer(const Piece& piece);

// What parts a piece: of every inner vertex 0 or 1, the side it is on, or 2, in the separator. No edge joins the sides.
using Separation = std::vector<char>;
constexpr char in_separator = 2;

// The connected parts of a piece without its separator, each in ascending order, as the graph calls them.
graph::Lists<> parts(const Piece& piece, const Separation& side);

}  // namespace sg::order
