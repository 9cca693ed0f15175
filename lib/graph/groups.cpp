#include "lib/graph/groups.h"

#include <numeric>

namespace sg {

Groups grouped(const std::vector<Index>& group_of, Index groups) {
  Groups result;
  result.begin.assign(groups + 1, 0);
  for (Index k : group_of) {
    if (k >= 0) ++result.begin[k + 1];
  }
  std::partial_sum(result.begin.begin(), result.begin.end(), result.begin.begin());
  result.items.resize(result.begin.back());
  std::vector<Index> at(result.begin.begin(), result.begin.end() - 1);
  for (Index i = 0; i < static_cast<Index>(group_of.size()); ++i) {
    if (group_of[i] >= 0) result.items[at[group_of[i]]++] = i;
  }
  return result;
}

}  // namespace sg
