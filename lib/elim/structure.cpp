#include "lib/elim/structure.h"

#include <algorithm>
#include <cassert>

namespace sg::elim {

void visit_separators(const OrderedPattern& pattern, const std::vector<Index>& parent,
                      const VisitSeparator& visit) {
  assert(parent.size() == pattern.dim.size());
  std::vector<std::vector<Index>> named(pattern.variables());  // by children that have gone
  Index r = 0;                                                 // rows are grouped by first position
  for (Index k = 0; k < pattern.variables(); ++k) {
    std::vector<Index> separator = std::move(named[k]);
    for (; r < pattern.rows.size() && pattern.rows[r].front() == k; ++r) {
      separator.insert(separator.end(), pattern.rows[r].begin(), pattern.rows[r].end());
    }
    std::sort(separator.begin(), separator.end());
    separator.erase(std::unique(separator.begin(), separator.end()), separator.end());
    std::erase(separator, k);
    visit(k, separator);
    if (parent[k] < 0) continue;
    std::vector<Index>& above = named[parent[k]];
    if (above.empty()) {
      above = std::move(separator);
    } else {
      above.insert(above.end(), separator.begin(), separator.end());
    }
  }
}

}  // namespace sg::elim
