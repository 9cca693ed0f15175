#include "lib/order/coarse.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

#include "lib/order/amd.h"
#include "lib/order/breadth_first.h"
#include "lib/order/piece.h"
#include "lib/parallel/parallel.h"

namespace sg::order {
namespace {

constexpr double from = 0.25, to = 0.75;  // of a region: where its separator may be

struct Work {
  const graph::Adjacency& graph;
  const std::vector<int> weight;  // of every vertex: 1
  // Of every vertex, its level in the last search of its region. Regions are apart, so that no thread looks at what another
  // writes: around a region there are separators, which have been met.
  std::vector<Index> distance;
  Index leaf;
};

// All vertices of a region, one component's levels after the other's.
std::vector<Index> search(Work& work, std::span<const Index> region, Index root) {
  for (const Index v : region) work.distance[v] = not_met;
  std::vector<Index> sequence;
  sequence.reserve(region.size());
  breadth_first(work.graph, root, 0, work.distance, sequence);
  for (const Index v : region) {
    if (work.distance[v] != not_met) continue;
    const Index beyond = work.distance[sequence.back()] + 1;
    breadth_first(work.graph, v, beyond, work.distance, sequence);
  }
  return sequence;
}

struct Level {
  std::size_t begin = 0, end = 0;  // in a sequence
};

// The smallest in the middle; empty if none is there.
Level smallest_level(const Work& work, const std::vector<Index>& sequence) {
  const auto size = static_cast<double>(sequence.size());
  Level best;
  for (std::size_t begin = 0, end = 0; begin < sequence.size(); begin = end) {
    const Index level = work.distance[sequence[begin]];
    while (end < sequence.size() && work.distance[sequence[end]] == level) ++end;
    const bool in_middle =
        static_cast<double>(begin) >= from * size && static_cast<double>(end) <= to * size;
    const bool smaller = best.end == 0 || end - begin < best.end - best.begin;
    if (in_middle && smaller) best = {begin, end};
  }
  return best;
}

void order_leaf(const Work& work, std::span<Index> region) {
  std::vector<Index> number(work.weight.size(), 0);
  const Piece part = piece(work.graph, work.weight, {region.begin(), region.end()}, number);
  std::vector<Index> outer(part.outer.size());
  std::iota(outer.begin(), outer.end(), part.size());
  const graph::Order order = minimum_degree(with_outer(part), outer);
  std::copy_n(order.begin(), region.size(), region.begin());
  for (Index& v : region) v = part.inner[v];
}

// The region's vertices, in ascending order, become an order of it.
void dissect(Work& work, std::span<Index> region) {
  if (region.size() <= static_cast<std::size_t>(work.leaf)) return order_leaf(work, region);
  const Index far = search(work, region, region.front()).back();
  std::vector<Index> sequence = search(work, region, far);
  const Level level = smallest_level(work, sequence);
  if (level.end == 0) return order_leaf(work, region);
  const auto begin = sequence.begin();
  std::rotate(begin + static_cast<std::ptrdiff_t>(level.begin),
              begin + static_cast<std::ptrdiff_t>(level.end), sequence.end());
  std::ranges::copy(sequence, region.begin());
  const std::size_t separator = level.end - level.begin;
  const std::span<Index> below = region.first(level.begin);
  const std::span<Index> above =
      region.subspan(level.begin, region.size() - separator - level.begin);
  std::ranges::sort(below);
  std::ranges::sort(above);
  parallel::both([&] { dissect(work, below); }, [&] { dissect(work, above); });
}

}  // namespace

graph::Order coarse_dissection(const graph::Adjacency& graph, Index leaf) {
  const auto size = static_cast<std::size_t>(graph.size());
  Work work{graph, std::vector<int>(size, 1), std::vector<Index>(size, not_met), leaf};
  graph::Order order(size);
  std::iota(order.begin(), order.end(), 0);
  if (!order.empty()) dissect(work, order);
  return order;
}

}  // namespace sg::order
