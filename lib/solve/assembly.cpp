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
  runs.resize(first + variables.size() + 1);
  Run* const begin = runs.data() + first;
  Run* end = begin;
  bool ascend = true;
  int from = 0;
  const auto append = [&](int to, int length) {
    Run* const last = end - 1;
    if (end != begin && last->to + last->length == to && last->from + last->length == from) {
      last->length += length;
    } else {
      ascend = ascend && (end == begin || last->to < to);
      *end++ = {from, to, length};
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
  if (!ascend) std::ranges::sort(begin, end, {}, &Run::to);
  runs.resize(end - runs.data());
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
