// The weighted number of spanning trees of a growing graph, and effective resistances in it.
//
// A link (u, v) of weight w adds w (e_u - e_v)(e_u - e_v)^T to the graph's Laplacian. Every
// connected part of the graph is tied to the ground by a link of weight 1 at one of its nodes, so
// that the determinant of the Laplacian is the product over the parts of their weighted numbers of
// spanning trees (Kirchhoff), and resistances within a part are what they are without ground. A
// link that joins two parts multiplies the product by its weight, any other by 1 + w R with R the
// effective resistance between its ends.
//
// The Laplacian is kept as L D L^T on a pattern that holds all links that will ever come, under
// AMD. Then v lies on u's path to the root of the elimination tree, a resistance is one triangular
// solve along that path, and a new link is a rank-1 update along it (Gill, Golub, Murray, Saunders:
// Methods for modifying matrix factorizations, 1974, method C1; Davis, Direct Methods for Sparse
// Linear Systems, section 6.3). Memory is that of L.
#pragma once

#include <span>
#include <vector>

#include "lib/trees/tree_weights.h"

namespace sg::trees {

struct SpanningTrees {
  std::vector<Index> position;  // of every node in the elimination order
  std::vector<Index> begin;     // n + 1, into row and value: columns of L below the diagonal
  std::vector<Index> row;       // ascending in a column: the first is the parent
  std::vector<double> value;
  std::vector<double> diagonal;  // D
  double log_trees = 0;          // log of the product over the parts

  std::vector<Index> part;    // union-find over nodes: parent, itself at a root
  std::vector<Index> ground;  // of a root: the node that ties its part to the ground
  std::vector<double> work;   // zeros between calls, by position
};

// The graph of the links whose weight is positive; those of weight 0 may come later. Links from a
// node to itself have no part in anything. Throws a computation Error if the Laplacian is too badly
// scaled to be factored.
SpanningTrees spanning_trees(Index nodes, std::span<const TreeEdge> links,
                             std::span<const double> weight);

bool joined(SpanningTrees& trees, const TreeEdge& link);
// Between the ends of one of the pattern's links, which must be joined.
double resistance(SpanningTrees& trees, const TreeEdge& link);
// What adding one of the pattern's links with weight > 0 does to log_trees: log(w) if it joins two
// parts, log(1 + w R) otherwise.
double gain(SpanningTrees& trees, const TreeEdge& link, double weight);
// Adds it, and returns its gain.
double add_link(SpanningTrees& trees, const TreeEdge& link, double weight);

// x <- M^-1 x with M the grounded Laplacian; x by node.
void solve(SpanningTrees& trees, std::span<double> x);

}  // namespace sg::trees
