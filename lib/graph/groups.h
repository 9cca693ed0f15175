// Items 0, 1, ... sorted into groups and laid flat: the lists of a list of lists, without the lists.
#pragma once

#include <span>
#include <vector>

#include "lib/graph/graph.h"

namespace sg {

struct Groups {
  std::vector<Index> begin;  // of every group, into items; and the end
  std::vector<Index> items;
  Index size() const { return static_cast<Index>(begin.size()) - 1; }
  std::span<const Index> operator[](Index k) const {
    return {items.data() + begin[k], static_cast<std::size_t>(begin[k + 1] - begin[k])};
  }
};

// Item i goes to group group_of[i] of 0 .. groups - 1, where items ascend; those of group -1 are
// left out.
Groups grouped(const std::vector<Index>& group_of, Index groups);

}  // namespace sg
