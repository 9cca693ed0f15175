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
  bool ascend = true;
  int from = 0;
  const auto append = [&](int to, int length) {
    const bool has_last = runs.size() > first;
    if (has_last && runs.back().to + runs.back().length == to &&
        runs.back().from + runs.back().length == from) {
      runs.back().length += length;
    } else {
      ascend = ascend && (!has_last || runs.back().to < to);
      runs.push_back({from, to, length});
    }
    from += length;
  };
  for (Index j : variables) {
    assert(row_at[j] + dim[j] <= last_row);
    if (row_at[j] >= 0) {
      append(row_at[j], dim[j]);
    } else {
      from += dim[j];
    }
  }
  append(last_row, 1);
  if (!ascend) std::ranges::sort(std::span(runs).subspan(first), {}, &Run::to);
  return ascend;
}

void add_child(const Kernels& kernel, const Front& child, std::span<const Run> runs,
               const Front& front) {
  const int count = static_cast<int>(runs.size());
  if (child.u) {
    kernel.add(front, child.u, child.ld_u(), runs.data(), count);
  } else {
    kernel.subtract_square(front, child.l + child.f, child.ld_l(), child.f, runs.data(), count);
  }
}

}  // namespace sg::solve
