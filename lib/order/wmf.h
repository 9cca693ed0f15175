// Weighted minimum fill (wmf): a greedy ordering for graphs whose variables have dimensions.
//
// The graph. Vertices are the variables, weighted by tangent dimension d; an edge joins two that
// share a factor. Eliminating v joins its neighbours N(v) to a clique. What elimination costs is
//
//     EC = sum over variables of d_f (d_f + d_s)^2
//
// (Frey, Steiner, How, eq. 2), and what makes later fronts large is fill: minimum degree (AMD,
// COLAMD) looks at the size of N(v) alone, and so takes no notice of how much of the clique is
// already there. Minimum fill (also: minimum deficiency; Rose 1972; Rothberg, Eisenstat 1998; Ng,
// Raghavan 1999) does, and saves most where variables have many neighbours that know each other:
// landmarks seen from consecutive poses.
//
// The score. The next variable, or supervariable, is the one with the least
//
//     fill(v) / sqrt(d (d + d_s)),    fill(v) = sum of d_a d_b over non-adjacent {a, b} in N(v),
//
// d and d_s being its frontal and separator dimension. The root is the geometric mean of the two
// sides of the part of R that this elimination completes. Its factor sqrt(d) makes a supervariable
// pay per variable that it removes from the graph, as in approximate minimum mean local fill
// (Rothberg, Eisenstat); its factor sqrt(d + d_s) forgives fill among many neighbours, who would
// soon have met anyhow. On SLAM graphs this takes a tenth off the EC of plain minimum fill, on
// dense landmark graphs a third. A variable of no fill (simplicial) scores 0 and goes at once,
// which some optimal order does too. Before v goes a neighbour of it that has no other neighbours
// than v's, if that is cheaper (better_first in fill_graph.h): mass elimination, the right way
// around. Ties go to the lowest index, or by seed.
//
// No greedy is best everywhere: amd is one of the candidates, where the pass was quick plain fill is another, and on a dense
// graph a pass by bounds alone (below); the least EC wins. Graphs that are wide in all directions are parted by separators
// first, and the greedy orders what these leave, or more of it where that is cheaper (dissect.h). What amd costs for every entry
// of the graph tells which they are: a large wide one is dissected, and ordered by the greedy too only if it turns out not to be
// very wide; a small wide one is ordered both ways; others, and those of many neighbours a variable, are not dissected. With `last` it is one pass: that form
// orders parts of a graph anew at every step of a replay, where time is short.
//
// Exactness. While the graph is small enough, fill is exact, kept up to date edge by edge
// (fill_graph.h). When the work for that has grown past a fixed multiple of the size of the input,
// the rest of the graph is handed on as a quotient graph, with upper bounds for degree and fill
// (quotient_graph.h). SLAM graphs of some ten thousand poses are ordered exactly to the end; of a
// million poses, all but the core.
//
// Complexity. With n variables and m adjacent pairs: exact part O((n + m) exact_work) by its budget,
// plus O(log n) for every changed score; bounded part as AMD's, O(nm) in the worst case and near
// linear in practice. Memory O(n + m) and the edges of one elimination graph.
//
// Sources. Amestoy, Davis, Duff, An approximate minimum degree ordering algorithm, SIAM J. Matrix
// Anal. Appl. 17 (1996): quotient graph, element absorption, mass elimination, supervariables.
// Rothberg, Eisenstat, Node selection strategies for bottom-up sparse matrix ordering, SIAM J.
// Matrix Anal. Appl. 19 (1998); Ng, Raghavan, Performance of greedy ordering heuristics for sparse
// Cholesky factorization, SIAM J. Matrix Anal. Appl. 20 (1999): the family of scores and bounds.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "lib/elim/score.h"
#include "lib/graph/pattern.h"

namespace sg::order {

// What the greedy minimizes at each step: the score above, or fill alone.
enum class FillScore { balanced, plain };

struct GreedyOptions {
  FillScore score = FillScore::balanced;
  std::vector<int> stage;  // of every variable: all of a lower stage go first; empty: one stage
  std::uint64_t seed = 0;  // 0: ties go to the lowest index; else to the lowest pseudo-random rank
  double jitter = 0;       // scores are multiplied by 1 + jitter u, u in [0, 1) drawn per variable
  std::int64_t exact_work = 120;  // list entries looked at per variable and adjacency entry, in the
                                  // exact part
  // Give up as soon as EC is above, or the bounded part has looked at more list entries.
  elim::Wide limit = ~elim::Wide{0};
  std::int64_t bounded_work = std::numeric_limits<std::int64_t>::max();
};

struct GreedyResult {
  graph::Order order;     // empty if it was given up
  elim::Wide ec = 0;      // of `order`
  std::int64_t work = 0;  // list entries looked at in the exact part
};

// One greedy pass. graph: adjacency(pattern).
GreedyResult greedy_fill(const graph::Pattern& pattern, const graph::Adjacency& graph,
                         const GreedyOptions& options);

// One pass over a part of a graph (fill_graph.h): its first `inner` variables. The order is of
// these alone, and so is its EC. Neither seed nor stage. limit: as in GreedyOptions.
GreedyResult greedy_fill_of_part(const graph::Adjacency& graph, const std::vector<int>& dim,
                                 Index inner, elim::Wide limit = ~elim::Wide{0});

// Whether dissection may do better than a greedy order of this EC: whether it is high for so many edges.
bool is_wide(const graph::Adjacency& graph, elim::Wide ec);

struct WmfOptions {
  std::vector<Index> last;  // to be eliminated after all others
  std::uint64_t seed = 0;   // as in GreedyOptions
};

// The best of the passes and the dissection that the graph's size and width afford.
graph::Order wmf(const graph::Pattern& pattern, const WmfOptions& options = {});

}  // namespace sg::order
