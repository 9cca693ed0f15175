#include "lib/order/dissect.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <utility>

#include "lib/order/fill_graph.h"
#include "lib/order/separator.h"
#include "lib/order/wmf.h"

namespace sg::order {
namespace {

constexpr double largest_part = 0.9;  // of a piece; a separator that leaves more parts nothing
constexpr double narrow = 30'000;     // EC a list entry, up to which minimum fill may win

constexpr Index small = 300;   // not parted
constexpr Index medium = 600;  // nor these, where minimum fill is as good:

// where variables have many neighbours,
bool is_rich(const Piece& piece) {
  return piece.entries() > 8 * static_cast<std::size_t>(piece.size());
}

// and where elimination costs so little for every list entry.
bool is_cheap(const Piece& piece, elim::Wide ec) {
  return ec <= 1300 * static_cast<elim::Wide>(piece.entries());
}

// Up to so many times what dissection of a piece costs, minimum fill may win the piece around it. The larger, the less: its
// passes take longer, and what was lost in one part is seldom won back.
double near(const Piece& piece) {
  return 1 + std::min(0.05, 15.0 / piece.size());
}

struct Graph {
  const graph::Adjacency& adjacency;
  const std::vector<int>& dim;
  std::uint64_t seed;
  std::vector<Index> number;  // scratch: n zeros
  bool cheap = false;  // what minimum fill ordered last; the next piece is most often its neighbour
};

// An order of a piece, and whether minimum fill comes near it, or did in a part.
struct Ordered {
  Dissected found;
  bool contested = false;
};

// Empty if EC is above the limit.
Dissected by_minimum_fill(const Piece& piece, elim::Wide limit = ~elim::Wide{0}) {
  std::vector<int> dim = piece.inner_weight;
  dim.insert(dim.end(), piece.outer_weight.begin(), piece.outer_weight.end());
  GreedyResult found = greedy_fill_of_part(with_outer(piece), dim, piece.size(), limit);
  for (Index& v : found.order) v = piece.inner[v];
  return {std::move(found.order), found.ec};
}

// The separator of a piece as it is once the parts have gone: each of them has joined what is around it.
struct Top {
  graph::Order order;      // of the separator, in places of Piece::inner
  graph::Pattern pattern;  // variables: the separator in this order, then what is around the piece
};

Index separator_size(const Top& top) {
  return static_cast<Index>(top.order.size());
}

// With the separator's own edges alone.
Top top(const Piece& piece, const Separation& side) {
  Top result;
  std::vector<Index> place(side.size(), -1);
  for (Index v = 0; v < piece.size(); ++v) {
    if (side[v] != in_separator) continue;
    place[v] = separator_size(result);
    result.order.push_back(v);
    result.pattern.dim.push_back(piece.inner_weight[v]);
  }
  const Index size = separator_size(result);
  std::vector<int>& dim = result.pattern.dim;
  dim.insert(dim.end(), piece.outer_weight.begin(), piece.outer_weight.end());
  for (Index k = 0; k < size; ++k) {
    const Index v = result.order[k];
    for (const Index u : piece.inside[v]) {
      if (place[u] > k) result.pattern.rows.add(std::array{k, place[u]});
    }
    for (const Index b : piece.around[v]) result.pattern.rows.add(std::array{k, size + b});
  }
  return result;
}

// Joins what is around each of the parts. number: scratch of n zeros.
void join_around(const Piece& piece, const graph::Lists<>& around, std::vector<Index>& number,
                 Top& top) {
  const Index size = separator_size(top);
  for (Index k = 0; k < size; ++k) number[piece.inner[top.order[k]]] = k;
  for (std::size_t b = 0; b < piece.outer.size(); ++b) {
    number[piece.outer[b]] = size + static_cast<Index>(b);
  }
  for (Index part = 0; part < around.size(); ++part) {
    for (const Index v : around[part]) top.pattern.rows.items.push_back(number[v]);
    if (!around[part].empty()) top.pattern.rows.close();
  }
  for (const Index v : top.order) number[piece.inner[v]] = 0;
  for (const Index v : piece.outer) number[v] = 0;
}

elim::Wide separator_ec(const Top& top) {
  graph::Order order(top.pattern.dim.size());
  std::iota(order.begin(), order.end(), 0);
  const elim::Symbolic symbolic = elim::symbolic(top.pattern, order);
  elim::Wide ec = 0;
  for (Index k = 0; k < separator_size(top); ++k) {
    ec += elim::elimination_cost(symbolic.dim[k], symbolic.count[k]);
  }
  return ec;
}

void append(Dissected& all, const Dissected& part) {
  all.order.insert(all.order.end(), part.order.begin(), part.order.end());
  all.ec += part.ec;
}

Ordered dissected(Graph& graph, const Piece& piece);

// All parts, one after the other. Their surroundings, if they are wanted, are added to `around`.
Ordered dissected(Graph& graph, const graph::Lists<>& parts, graph::Lists<>& around) {
  Ordered all{{{}, 0}, false};
  for (Index k = 0; k < parts.size(); ++k) {
    const Piece part =
        piece(graph.adjacency, graph.dim, {parts[k].begin(), parts[k].end()}, graph.number);
    const Ordered one = dissected(graph, part);
    append(all.found, one.found);
    all.contested = all.contested || one.contested;
    around.add(part.outer);
  }
  return all;
}

bool parts_nothing(const Piece& piece, const graph::Lists<>& parts) {
  Index largest = 0;
  for (Index k = 0; k < parts.size(); ++k) {
    largest = std::max(largest, static_cast<Index>(parts[k].size()));
  }
  return largest > largest_part * piece.size();
}

// Minimum fill's order in place of another, if it is cheaper. Where nothing is around, that is for the caller to try.
// whole: that order, if it is known.
void contest(const Piece& piece, Dissected whole, Ordered& by_parts) {
  if (piece.outer.empty()) return;
  const auto ec = static_cast<double>(by_parts.found.ec);
  by_parts.contested = by_parts.contested && ec <= narrow * static_cast<double>(piece.entries());
  if (!by_parts.contested) return;
  const auto most = static_cast<elim::Wide>(near(piece) * ec);
  if (whole.order.empty()) whole = by_minimum_fill(piece, most);
  by_parts.contested = !whole.order.empty() && whole.ec <= most;
  if (by_parts.contested && whole.ec < by_parts.found.ec) by_parts.found = std::move(whole);
}

Ordered not_parted(Graph& graph, const Piece& piece) {
  Ordered result{by_minimum_fill(piece), true};
  graph.cheap = is_cheap(piece, result.found.ec);
  return result;
}

Ordered dissected(Graph& graph, const Piece& piece) {
  if (piece.size() <= (is_rich(piece) ? medium : small)) return not_parted(graph, piece);
  Ordered whole{{{}, 0}, false};
  if (graph.cheap && piece.size() <= medium) {
    whole = not_parted(graph, piece);
    if (graph.cheap) return whole;
  }
  const Separation side = separation(piece, graph.seed + 1);
  if (side.empty()) return not_parted(graph, piece);
  const graph::Lists<> below = parts(piece, side);
  if (parts_nothing(piece, below)) return not_parted(graph, piece);
  graph::Lists<> around;
  Ordered result = dissected(graph, below, around);
  Top separator = top(piece, side);
  join_around(piece, around, graph.number, separator);
  for (const Index v : separator.order) result.found.order.push_back(piece.inner[v]);
  result.found.ec += separator_ec(separator);
  contest(piece, std::move(whole.found), result);
  return result;
}

// Eliminates what is simplicial or has few neighbours, until nothing is.
void reduce(FillGraph& g) {
  constexpr Index few = 3;
  const auto may_go = [&](Index v) {
    return g.variables.alive[v] && (g.list[v].live <= few || g.fill[v].fill == 0);
  };
  std::vector<Index> queue(g.list.size());
  std::iota(queue.begin(), queue.end(), 0);
  for (std::size_t at = 0; at < queue.size(); ++at) {
    if (!may_go(queue[at])) continue;
    eliminate(g, queue[at]);
    std::copy_if(g.changed.begin(), g.changed.end(), std::back_inserter(queue), may_go);
  }
}

// What is left of a graph, under numbers of its own.
struct Core {
  std::vector<Index> variables;
  graph::Adjacency graph;
  std::vector<int> weight;
};

Core core(FillGraph& g) {
  Core result;
  std::vector<Index> number(g.list.size(), -1);
  for (Index v = 0; v < static_cast<Index>(g.list.size()); ++v) {
    if (!g.variables.alive[v]) continue;
    number[v] = static_cast<Index>(result.variables.size());
    result.variables.push_back(v);
    result.weight.push_back(g.variables.weight[v]);
  }
  for (const Index v : result.variables) {
    for (const Index u : neighbours(g, v)) result.graph.items.push_back(number[u]);
    std::ranges::sort(result.graph.open());
    result.graph.close();
  }
  return result;
}

}  // namespace

Dissected nested_dissection(const graph::Adjacency& graph, const std::vector<int>& dim, Index inner,
                            std::uint64_t seed) {
  Graph g{graph, dim, seed, std::vector<Index>(dim.size(), 0)};
  std::vector<Index> all(inner);
  std::iota(all.begin(), all.end(), 0);
  const Piece whole = piece(graph, dim, std::move(all), g.number);
  graph::Lists<> around;
  return dissected(g, parts(whole, Separation(inner, 0)), around).found;
}

graph::Order dissect(const graph::Adjacency& graph, const std::vector<int>& dim,
                     std::uint64_t seed) {
  const std::int64_t size = static_cast<std::int64_t>(graph.items.size()) + graph.size();
  FillGraph g = fill_graph(graph, dim, {}, GreedyOptions{}.exact_work * size);
  if (g.exact) reduce(g);
  const Core rest = core(g);
  const Dissected found = nested_dissection(rest.graph, rest.weight, rest.graph.size(), seed);
  for (const Index k : found.order) eliminate_members(g.variables, rest.variables[k], 0);
  return std::move(g.variables.order);
}

}  // namespace sg::order
