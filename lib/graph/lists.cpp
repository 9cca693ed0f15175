#include "lib/graph/lists.h"

#include <limits>

#include "lib/text/error.h"

namespace sg::graph {

Index item_count(std::size_t items) {
  if (items > static_cast<std::size_t>(std::numeric_limits<Index>::max())) {
    throw text::computation_error(
        "the graph is too dense: more than 2^31 - 1 neighbours, separators or observations");
  }
  return static_cast<Index>(items);
}

Lists<> grouped(std::span<const Index> list_of, Index count) {
  return counting_sort(count, [&](const auto& put) {
    for (std::size_t i = 0; i < list_of.size(); ++i) {
      if (list_of[i] >= 0) put(list_of[i], static_cast<Index>(i));
    }
  });
}

Lists<> transpose(const Lists<>& lists, Index count) {
  return counting_sort(count, [&](const auto& put) {
    for (Index k = 0; k < lists.size(); ++k) {
      for (const Index item : lists[k]) put(item, k);
    }
  });
}

}  // namespace sg::graph
