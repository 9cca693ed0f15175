#include "lib/order/piece.h"

#include <algorithm>
#include <utility>

namespace sg::order {

Piece piece(const graph::Lists<>& adjacency, const std::vector<int>& weight,
            std::vector<Index> inner, std::vector<Index>& number) {
  Piece result;
  result.inner = std::move(inner);
  const auto size = static_cast<Index>(result.inner.size());
  for (Index k = 0; k < size; ++k) number[result.inner[k]] = k + 1;
  for (const Index v : result.inner) {
    result.inner_weight.push_back(weight[v]);
    for (const Index u : adjacency[v]) {
      if (number[u] > 0) {
        result.inside.items.push_back(number[u] - 1);
        continue;
      }
      if (number[u] == 0) {
        result.outer.push_back(u);
        result.outer_weight.push_back(weight[u]);
        number[u] = -static_cast<Index>(result.outer.size());
      }
      result.around.items.push_back(-number[u] - 1);
    }
    result.inside.close();
    result.around.close();
  }
  for (const Index v : result.inner) number[v] = 0;
  for (const Index u : result.outer) number[u] = 0;
  return result;
}

graph::Lists<> with_outer(const Piece& piece) {
  graph::Lists<> all;
  for (Index v = 0; v < piece.size(); ++v) {
    all.items.insert(all.items.end(), piece.inside[v].begin(), piece.inside[v].end());
    for (const Index b : piece.around[v]) all.items.push_back(piece.size() + b);
    all.close();
  }
  const graph::Lists<> back =
      graph::transpose(piece.around, static_cast<Index>(piece.outer.size()));
  for (Index b = 0; b < back.size(); ++b) all.add(back[b]);
  return all;
}

graph::Lists<> parts(const Piece& piece, const Separation& side) {
  graph::Lists<> result;
  std::vector<char> seen(side.size());
  for (std::size_t v = 0; v < side.size(); ++v) seen[v] = side[v] == in_separator;
  for (Index root = 0; root < piece.size(); ++root) {
    if (seen[root]) continue;
    seen[root] = true;
    std::vector<Index>& queue = result.items;
    std::size_t at = queue.size();
    queue.push_back(root);
    for (; at < queue.size(); ++at) {
      for (const Index u : piece.inside[queue[at]]) {
        if (seen[u]) continue;
        seen[u] = true;
        queue.push_back(u);
      }
    }
    std::sort(result.open().begin(), result.open().end());
    for (Index& v : result.open()) v = piece.inner[v];
    result.close();
  }
  return result;
}

}  // namespace sg::order
