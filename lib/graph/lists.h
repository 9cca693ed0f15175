// Lists of a list, laid flat: all items one after the other, and where each list begins. Sparse
// matrices call it compressed storage; here it holds the vertices of a graph's edges, the rows of a
// pattern, the neighbours in its graph, the cliques of a tree and all their like.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

// What every folder says without its namespace.
namespace sg {

using Index = std::int32_t;   // of vertices, variables, edges, factors
using Id = std::int64_t;      // as the file writes it: 0 .. 2^63-1
using Offset = std::int64_t;  // of the first byte of a line's content in Graph::text

}  // namespace sg

namespace sg::graph {

// So many items as an Index. Throws a computation Error where that is too narrow: what lists hold
// (neighbours, separators, observations) can be more than 2^31 - 1 in a small file already.
Index item_count(std::size_t items);

template <class Item = Index>
struct Lists {
  std::vector<Index> begin{0};  // of every list, into items; and the end
  std::vector<Item> items;

  Index size() const { return static_cast<Index>(begin.size()) - 1; }
  std::span<const Item> operator[](Index k) const {
    assert(0 <= k && k < size());
    return {items.data() + begin[k], static_cast<std::size_t>(begin[k + 1] - begin[k])};
  }

  // Lists are built one after the other: items behind the last end belong to the next list, which
  // is open until it is closed. Closing throws as item_count does.
  std::span<Item> open() { return std::span(items).subspan(begin.back()); }
  void close() { begin.push_back(item_count(items.size())); }
  void add(std::span<const Item> list) {
    items.insert(items.end(), list.begin(), list.end());
    close();
  }
  void clear() {
    begin.assign(1, 0);
    items.clear();
  }
};

// Items sorted into lists 0 .. count - 1, in each of them as they come. `each(put)` calls
// put(list, item) for all items, and does so twice.
template <class Item = Index>
Lists<Item> counting_sort(Index count, const auto& each) {
  Lists<Item> result;
  std::vector<Index>& begin = result.begin;
  begin.assign(static_cast<std::size_t>(count) + 2, 0);
  each([&](Index list, const Item&) {
    assert(0 <= list && list < count);
    ++begin[list + 2];
  });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  result.items.resize(begin.back());
  each([&](Index list, const Item& item) { result.items[begin[list + 1]++] = item; });
  begin.pop_back();
  return result;
}

// Item i goes to list list_of[i] of 0 .. count - 1, where items ascend; those of list -1 are left
// out.
Lists<> grouped(std::span<const Index> list_of, Index count);

// For every item 0 .. count - 1 the lists that hold it, ascending.
Lists<> transpose(const Lists<>& lists, Index count);

}  // namespace sg::graph
