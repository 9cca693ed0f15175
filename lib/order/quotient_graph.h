// The elimination graph as a quotient graph: every eliminated variable leaves an *element*, the
// clique of its neighbours, instead of edges. It never takes more memory than the graph that it
// started from, and an elimination looks only at the elements around it (George, Liu 1981;
// Amestoy, Davis, Duff, An approximate minimum degree ordering algorithm, 1996, whose names of
// things are used here).
//
// For a variable i: A_i, its neighbours by edges that no element covers, and E_i, its elements; for
// an element e: L_e, its variables. When p is eliminated, L_p is the union of A_p and L_e of its
// elements, which are absorbed; and for every other element e around, d(L_e \ L_p) is computed for
// all at once by counting down from d(L_e). An e without anything outside L_p is absorbed too
// (aggressive absorption); a variable without anything outside L_p is eliminated with p (mass
// elimination); variables of L_p with equal A and E merge (supervariables, by hash).
//
// Degree and fill are bounds from above. With outside parts o_e = d(L_e \ L_p) of the elements of i
// and c = d(L_p \ i):
//
//     degree(i) <= t = c + sum_e o_e + d(A_i)     (Amestoy, Davis, Duff; also: the former + c)
//     fill(i)   <= (t^2 - c^2 - sum_e o_e^2 - sum_{a in A_i} d_a^2) / 2
//                  - sum_e o_e (d(L_e) - o_e - d_i)
//
// where what is subtracted are the pairs that L_p and each e are known to join (Rothberg, Eisenstat
// 1998 subtract the largest clique, Ng, Raghavan 1999 that of the newest element; the parts are
// disjoint in this count, so that all of them may go).
#pragma once

#include <cstdint>
#include <vector>

#include "lib/order/fill_graph.h"

namespace sg::order {

struct QuotientGraph {
  Supervariables variables;
  std::vector<int> stage;

  std::vector<std::vector<Index>> edges;     // A_i of a variable
  std::vector<std::vector<Index>> elements;  // E_i of a variable
  std::vector<std::vector<Index>> members;   // L_e of an element, called by its pivot
  std::vector<char> is_element;
  std::vector<std::int64_t> size;    // d(L_e) of an element
  std::vector<std::int64_t> degree;  // of a variable: bound from above
  std::vector<std::int64_t> fill;    // of a variable: bound from above
  std::vector<Index> changed;        // whose degree, fill or weight the last elimination changed
  std::int64_t work = 0;             // list entries looked at

  std::vector<int> mark, counted;     // scratch, by `stamp`
  std::vector<std::int64_t> outside;  // d(L_e \ L_p), where counted
  int stamp = 0;
};

// What is left of a graph, as a quotient graph without elements. The fill graph is used up.
QuotientGraph quotient_graph(FillGraph&& graph);

// Takes p, which must be alive, and all that merged into it.
void eliminate(QuotientGraph& graph, Index p);

}  // namespace sg::order
