// A priority queue of variables whose keys change: an indexed 4-ary heap.
#pragma once

#include <cassert>
#include <cstddef>
#include <vector>

#include "lib/graph/pattern.h"

namespace sg::order {

// Smallest key first; of equal keys the smallest rank. Ranks differ, so the order is strict.
struct MinQueue {
  std::vector<double> key;
  std::vector<Index> rank;
  std::vector<Index> heap;
  std::vector<Index> place;  // in the heap, -1 of a variable that is not in it

  explicit MinQueue(Index n = 0) : key(n), rank(n), place(n, -1) {}
  bool empty() const { return heap.empty(); }
  bool holds(Index v) const { return place[v] >= 0; }
};

namespace min_queue_detail {

inline bool before(const MinQueue& queue, Index a, Index b) {
  return queue.key[a] < queue.key[b] ||
         (queue.key[a] == queue.key[b] && queue.rank[a] < queue.rank[b]);
}

inline void put(MinQueue& queue, std::size_t at, Index v) {
  queue.heap[at] = v;
  queue.place[v] = static_cast<Index>(at);
}

inline void rise(MinQueue& queue, std::size_t at) {
  const Index v = queue.heap[at];
  for (; at > 0 && before(queue, v, queue.heap[(at - 1) / 4]); at = (at - 1) / 4) {
    put(queue, at, queue.heap[(at - 1) / 4]);
  }
  put(queue, at, v);
}

inline void sink(MinQueue& queue, std::size_t at) {
  const Index v = queue.heap[at];
  const std::size_t size = queue.heap.size();
  for (std::size_t child = 4 * at + 1; child < size; child = 4 * at + 1) {
    std::size_t least = child;
    for (std::size_t c = child + 1; c < child + 4 && c < size; ++c) {
      if (before(queue, queue.heap[c], queue.heap[least])) least = c;
    }
    if (!before(queue, queue.heap[least], v)) break;
    put(queue, at, queue.heap[least]);
    at = least;
  }
  put(queue, at, v);
}

}  // namespace min_queue_detail

// Inserts v, or changes its key.
inline void set_key(MinQueue& queue, Index v, double key) {
  using namespace min_queue_detail;
  assert(0 <= v && v < static_cast<Index>(queue.place.size()));
  if (!queue.holds(v)) {
    queue.key[v] = key;
    queue.heap.push_back(v);
    rise(queue, queue.heap.size() - 1);
  } else if (key < queue.key[v]) {
    queue.key[v] = key;
    rise(queue, queue.place[v]);
  } else if (key > queue.key[v]) {
    queue.key[v] = key;
    sink(queue, queue.place[v]);
  }
}

// Takes v out; nothing if it is not in.
inline void erase(MinQueue& queue, Index v) {
  using namespace min_queue_detail;
  if (!queue.holds(v)) return;
  const auto at = static_cast<std::size_t>(queue.place[v]);
  const Index moved = queue.heap.back();
  queue.heap.pop_back();
  queue.place[v] = -1;
  if (moved == v) return;
  put(queue, at, moved);
  rise(queue, at);
  sink(queue, queue.place[moved]);
}

inline Index pop(MinQueue& queue) {
  assert(!queue.empty());
  const Index v = queue.heap.front();
  erase(queue, v);
  return v;
}

}  // namespace sg::order
