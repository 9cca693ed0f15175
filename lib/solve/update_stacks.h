// Where updates lie while cliques are eliminated one after the other (eliminate.h): on two stacks, by even and odd depth.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "lib/graph/lists.h"

namespace sg::solve {

// Of every clique, 0 at a root; parents come after their children.
inline std::vector<int> depths(std::span<const Index> parent) {
  std::vector<int> depth(parent.size(), 0);
  for (auto c = static_cast<Index>(parent.size()) - 1; c >= 0; --c) {
    if (parent[c] >= 0) depth[c] = depth[parent[c]] + 1;
  }
  return depth;
}

// Places the updates of cliques first..last from `base` on and returns where they end. size(c): numbers of c's update.
// at: -1 where none is formed, else written over.
template <class Size>
Offset place_updates(Index first, Index last, const graph::Lists<>& children,
                     std::span<const int> depth, Offset base, const Size& size,
                     std::span<Offset> at) {
  Offset top[2] = {0, 0};
  Offset peak[2] = {0, 0};
  for (Index c = first; c <= last; ++c) {
    const int side = depth[c] % 2;
    if (at[c] >= 0) {
      at[c] = top[side];
      top[side] += size(c);
    }
    peak[side] = std::max(peak[side], top[side]);
    for (const Index child : children[c]) {
      if (child >= first && at[child] >= 0) top[1 - side] = std::min(top[1 - side], at[child]);
    }
  }
  for (Index c = first; c <= last; ++c) {
    if (at[c] >= 0) at[c] += base + (depth[c] % 2 == 0 ? 0 : peak[0]);
  }
  return base + peak[0] + peak[1];
}

}  // namespace sg::solve
