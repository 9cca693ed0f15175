#include "lib/elim/filled_graph.h"

#include <algorithm>
#include <iterator>

#include "lib/elim/structure.h"

namespace sg::elim {
namespace {

// What of `wanted` is not in the separator. A few are looked up.
void set_missing(const std::vector<Index>& wanted, const std::vector<Index>& separator,
                 std::vector<Index>& missing) {
  missing.clear();
  if (wanted.size() < 4) {
    for (const Index j : wanted) {
      if (!std::ranges::binary_search(separator, j)) missing.push_back(j);
    }
  } else {
    std::ranges::set_difference(wanted, separator, std::back_inserter(missing));
  }
}

// Walks up from the factor's first variable; calls grow(k, count) wherever filled.added comes into a
// separator.
Wide walk(FilledGraph& filled, std::span<const Index> factor, const auto& grow) {
  if (factor.empty()) return 0;
  auto& [dim, separators, counts, ec, wanted, added, merged] = filled;
  Wide sum = 0;
  wanted.assign(factor.begin() + 1, factor.end());
  for (Index k = factor.front();;) {
    const std::vector<Index>& separator = separators[k];
    set_missing(wanted, separator, added);
    if (added.empty() && counts[k] > 0) return sum;
    std::int64_t count = std::max<std::int64_t>(counts[k], dim[k]);
    for (const Index j : added) count += dim[j];
    sum += elimination_cost(dim[k], count) - elimination_cost(dim[k], counts[k]);
    Index parent = separator.empty() ? -1 : separator.front();
    if (!added.empty() && (parent < 0 || added.front() < parent)) {
      parent = added.front();
      merged.clear();
      std::ranges::merge(separator, added, std::back_inserter(merged));
      wanted.assign(merged.begin() + 1, merged.end());
    } else {
      wanted = added;
    }
    grow(k, count);
    if (wanted.empty()) return sum;
    k = parent;
  }
}

}  // namespace

FilledGraph filled_graph(const OrderedPattern& pattern, Index absent) {
  const Index n = pattern.variables();
  FilledGraph filled;
  filled.dim = pattern.dim;
  filled.separator.resize(n);
  filled.count.assign(n, 0);
  visit_separators(pattern, elimination_tree(pattern),
                   [&](Index k, std::span<const Index> separator) {
                     if (k < absent) return;
                     filled.separator[k].assign(separator.begin(), separator.end());
                     filled.count[k] = filled.dim[k];
                     for (const Index j : separator) filled.count[k] += filled.dim[j];
                     filled.ec += elimination_cost(filled.dim[k], filled.count[k]);
                   });
  return filled;
}

Wide increase(FilledGraph& filled, std::span<const Index> factor) {
  return walk(filled, factor, [](Index, std::int64_t) {});
}

Wide add_factor(FilledGraph& filled, std::span<const Index> factor) {
  const Wide sum = walk(filled, factor, [&](Index k, std::int64_t count) {
    std::vector<Index>& separator = filled.separator[k];
    const auto middle = static_cast<std::ptrdiff_t>(separator.size());
    separator.insert(separator.end(), filled.added.begin(), filled.added.end());
    std::inplace_merge(separator.begin(), separator.begin() + middle, separator.end());
    filled.count[k] = count;
  });
  filled.ec += sum;
  return sum;
}

}  // namespace sg::elim
