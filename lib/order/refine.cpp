#include "lib/order/refine.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

namespace sg::order {
namespace {

struct Refinement {
  const Piece& piece;
  const Prices& prices;
  Separation& side;
  Tally tally;  // of it

  // Of vertices in the separator: weight of the neighbours on each side.
  std::vector<std::array<int, 2>> pull;
  std::vector<Index> separator;  // its vertices, and perhaps some that have left it
  std::vector<int> moved;        // the pass in which a vertex last left it
  std::vector<int> listed;       // the pass in which `separator` last took it in
  int pass = 0;

  // By side: what the separator would lose, and the vertex; entries may be out of date.
  std::array<std::vector<std::pair<int, Index>>, 2> heap;
  std::vector<std::pair<Index, char>> trail;  // vertices that changed, and what they were
};

int loss(const Refinement& r, Index v, int to) {
  return r.piece.inner_weight[v] - r.pull[v][1 - to];
}

void push(Refinement& r, Index v, int to) {
  r.heap[to].emplace_back(loss(r, v, to), -v);
  std::ranges::push_heap(r.heap[to]);
}

// The best to go to this side; -1 if there is none.
Index top(Refinement& r, int to) {
  auto& heap = r.heap[to];
  while (!heap.empty()) {
    const auto [lost, minus_v] = heap.front();
    if (r.side[-minus_v] == in_separator && r.moved[-minus_v] != r.pass &&
        loss(r, -minus_v, to) == lost) {
      return -minus_v;
    }
    std::ranges::pop_heap(heap);
    heap.pop_back();
  }
  return -1;
}

// Puts v on another side, or into the separator.
void assign(Refinement& r, Index v, char to) {
  change(r.piece, v, std::exchange(r.side[v], to), to, r.tally);
}

void list(Refinement& r, Index v) {
  if (std::exchange(r.listed[v], r.pass) != r.pass) r.separator.push_back(v);
}

void count_pull(Refinement& r, Index v) {
  r.pull[v] = {0, 0};
  for (const Index u : r.piece.inside[v]) {
    if (r.side[u] != in_separator) r.pull[v][r.side[u]] += r.piece.inner_weight[u];
  }
}

void pull_in(Refinement& r, Index u) {
  const char from = r.side[u];
  r.trail.emplace_back(u, from);
  assign(r, u, in_separator);
  list(r, u);
  for (const Index x : r.piece.inside[u]) {
    if (r.side[x] != in_separator) continue;
    r.pull[x][from] -= r.piece.inner_weight[u];
    if (r.moved[x] != r.pass) push(r, x, 1 - from);
  }
  count_pull(r, u);
  if (r.moved[u] == r.pass) return;
  push(r, u, 0);
  push(r, u, 1);
}

void move(Refinement& r, Index v, int to) {
  r.trail.emplace_back(v, in_separator);
  assign(r, v, static_cast<char>(to));
  r.moved[v] = r.pass;
  for (const Index u : r.piece.inside[v]) {
    if (r.side[u] != in_separator) continue;
    r.pull[u][to] += r.piece.inner_weight[v];
    if (r.moved[u] != r.pass) push(r, u, 1 - to);
  }
  for (const Index u : r.piece.inside[v]) {
    if (r.side[u] == 1 - to) pull_in(r, u);
  }
}

double price_of_move(const Refinement& r, Index v, int to) {
  Sizes after = r.tally.sizes;
  after.separator -= loss(r, v, to);
  after.side[to] += r.piece.inner_weight[v];
  after.side[1 - to] -= r.pull[v][1 - to];
  return price(r.prices, after);
}

// Back to where the trail was so long.
void undo(Refinement& r, std::size_t length) {
  for (; r.trail.size() > length; r.trail.pop_back()) {
    assign(r, r.trail.back().first, r.trail.back().second);
  }
}

void begin_pass(Refinement& r) {
  ++r.pass;
  std::vector<Index> candidates = std::move(r.separator);
  r.separator.clear();
  r.trail.clear();
  for (const int to : {0, 1}) r.heap[to].clear();
  for (const Index v : candidates) {
    if (r.side[v] != in_separator) continue;
    list(r, v);
    count_pull(r, v);
    for (const int to : {0, 1}) r.heap[to].emplace_back(loss(r, v, to), -v);
  }
  for (const int to : {0, 1}) std::ranges::make_heap(r.heap[to]);
}

// Returns the price, which is not above the one before.
double run_pass(Refinement& r, double before, int patience) {
  begin_pass(r);
  double best = before;
  std::size_t best_length = 0;
  for (int since = 0; since < patience; ++since) {
    const std::array<Index, 2> v{top(r, 0), top(r, 1)};
    std::array<double, 2> cost{};
    for (const int to : {0, 1}) {
      cost[to] = v[to] < 0 ? std::numeric_limits<double>::infinity() : price_of_move(r, v[to], to);
    }
    const int to = cost[1] < cost[0] ? 1 : 0;
    if (cost[to] == std::numeric_limits<double>::infinity()) break;
    move(r, v[to], to);
    const double now = price(r.prices, r.tally.sizes);
    if (now < best) {
      best = now;
      best_length = r.trail.size();
      since = -1;
    }
  }
  undo(r, best_length);
  return best;
}

Refinement refinement(const Piece& piece, const Prices& prices, Separation& side) {
  const std::size_t n = side.size();
  Refinement r{piece, prices, side, tally(piece, side), {}, {}, {}, {}, 0, {}, {}};
  r.pull.resize(n);
  r.moved.assign(n, 0);
  r.listed.assign(n, 0);
  for (Index v = 0; v < piece.size(); ++v) {
    if (side[v] == in_separator) r.separator.push_back(v);
  }
  return r;
}

}  // namespace

double refine(const Piece& piece, const Prices& prices, int passes, int patience,
              Separation& side) {
  Refinement r = refinement(piece, prices, side);
  double cost = price(prices, r.tally.sizes);
  for (int k = 0; k < passes; ++k) {
    const double before = std::exchange(cost, run_pass(r, cost, patience));
    if (cost >= before) break;
  }
  return cost;
}

}  // namespace sg::order
