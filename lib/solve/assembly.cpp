#include "lib/solve/assembly.h"

#include <algorithm>
#include <cassert>

namespace sg::solve {

int place_variables(std::span<const Index> frontals, std::span<const Index> separators,
                    std::span<const int> dim, std::span<int> row_at) {
  int row = 0;
  for (const auto& variables : {frontals, separators}) {
    for (Index j : variables) {
      row_at[j] = row;
      row += dim[j];
    }
  }
  return row;
}

bool append_runs(std::span<const Index> variables, std::span<const int> dim,
                 std::span<const int> row_at, int last_row, std::vector<Run>& runs) {
  const std::size_t first = runs.size();
  int from = 0;
  const auto append = [&](int to, int length) {
    const bool goes_on = runs.size() > first && runs.back().to + runs.back().length == to;
    if (goes_on) {
      runs.back().length += length;
    } else {
      runs.push_back({from, to, length});
    }
    from += length;
  };
  for (Index j : variables) {
    assert(0 <= row_at[j] && row_at[j] + dim[j] <= last_row);
    append(row_at[j], dim[j]);
  }
  append(last_row, 1);
  const std::span appended = std::span(runs).subspan(first);
  if (std::ranges::is_sorted(appended, {}, &Run::to)) return true;
  std::ranges::sort(appended, {}, &Run::to);
  return false;
}

}  // namespace sg::solve
