// The elimination graph with, for every variable, the exact weighted fill of eliminating it next.
//
// Notation: d_v the dimension of v (the weight of a supervariable), N(v) its neighbours. The fill of
// v is the size of what its elimination would add to the upper triangle of R:
//
//     fill(v) = sum over pairs {a, b} of N(v) that are not adjacent of d_a d_b.
//
// Eliminating v joins N(v) to a clique, edge by edge, and then takes v out. Both steps have an exact
// and local effect on every fill:
//
//   - A new edge {a, b} takes d_a d_b off fill(w) of every common neighbour w, and gives
//     d_b d(N(a) \ N(b)) to fill(a) and d_a d(N(b) \ N(a)) to fill(b). One pass over the
//     neighbours of b, those of a being marked.
//   - A v with fill 0 (simplicial: its neighbours are a clique) takes d_v d(N(u) \ N(v)) off fill(u)
//     of every neighbour u. From the degrees alone: O(|N(v)|), the lists of u are not looked at.
//
// The joining of N(v) ends when fill(v), counted down like every other, has reached 0. Its largest
// member's list is not searched for missing edges: the others know. So a hub that everybody sees
// costs nothing.
//
// Supervariables: H(v), the sum of mix(w) over v and its neighbours, is kept up to date in O(1) for
// every edge and vertex that comes or goes. After an elimination, members of N(v) with equal H are
// indistinguishable and merge; neighbours that have nothing outside N(v) are among them, so that
// mass elimination needs no step of its own.
//
// A part of a graph is ordered by itself with the variables around it, which are eliminated later: its
// *outer* variables. What they would be joined by costs the part nothing, so that any two of them count
// as joined, without an edge in any list; they never go, nobody asks for their fill, and those of the
// same inner neighbours merge.
//
// One unit of `work` is a list entry looked at.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "lib/order/supervariables.h"

namespace sg::order {

struct FillGraph {
  Supervariables variables;
  std::vector<int> stage;  // n: only variables of one stage merge
  Index inner;             // of a part: variables from here on are outer

  // What an elimination touches of a variable, side by side.
  struct Fill {
    std::int64_t fill;
    int weight;   // as in `variables`
    int changed;  // the round in which `changed` last took it in
  };
  std::vector<Fill> fill;            // n
  std::vector<std::int64_t> degree;  // n: scalar dimension of the neighbours
  std::vector<std::int64_t> around;  // n: that of the outer ones among them
  std::vector<std::uint64_t> hash;   // n: H(v)

  // Lists of neighbours in one pool. They may hold dead entries, which are dropped in passing.
  struct List {
    std::int64_t begin;
    Index size, capacity;
    Index live;  // entries that are alive
  };
  std::vector<List> list;  // n
  std::vector<Index> pool;

  std::vector<Index> changed;  // whose fill, degree or weight the last elimination changed
  std::int64_t work = 0;
  bool exact = true;  // false where counting the first fills alone would exceed the limit: fill
                      // then holds the bound that no two neighbours are adjacent

  // Scratch.
  std::vector<int> mark;  // equal to `stamp` for the marked
  int stamp = 0, round = 0;
  std::vector<Index> clique, miss_hub;
  std::vector<std::pair<std::uint64_t, Index>> by_hash;
};

// stage: of every variable; empty: one stage. work_limit: of counting the first fills, which is the
// listing of all triangles: O(m^1.5) for m edges.
FillGraph fill_graph(const graph::Adjacency& graph, const std::vector<int>& dim,
                     std::vector<int> stage, std::int64_t work_limit);
// The same of a part: the first `inner` variables, and around them the others, none of which may be
// adjacent to each other. Inner ones have stage 0, outer ones 1.
FillGraph fill_graph_of_part(const graph::Adjacency& graph, const std::vector<int>& dim,
                             Index inner, std::int64_t work_limit);

// Takes v, which must be alive, and all that merged into it. Needs an exact graph.
void eliminate(FillGraph& graph, Index v);

// About the least work that eliminating v takes: as many joins as pairs are missing, each over a list
// of as many as v's neighbours.
double least_work(const FillGraph& graph, Index v);

// A neighbour i of v, in v's stage, that had better go right before v: its neighbours are v and
// neighbours of v, so that both orders leave the same graph behind, and i, then v costs less than v,
// then i. v itself where there is none.
Index better_first(FillGraph& graph, Index v);

// The neighbours of v that are alive, without v.
std::span<const Index> neighbours(FillGraph& graph, Index v);

}  // namespace sg::order
