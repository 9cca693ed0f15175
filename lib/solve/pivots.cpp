#include "lib/solve/pivots.h"

#include <cassert>

namespace sg::solve {

void set_floors(const factor::LinearSystem& system, std::span<const Index> at,
                std::span<double> floors) {
  assert(at.size() >= system.pattern->dim.size());
  std::ranges::fill(floors, 0.0);
  for (Index r = 0; r < system.pattern->rows.size(); ++r) {
    const double* column = system.block(r);
    for (Index j : system.pattern->rows[r]) {
      for (int k = 0; k < system.pattern->dim[j]; ++k) {
        double square = 0;
        for (int i = 0; i < system.height[r]; ++i) square += column[i] * column[i];
        column += system.height[r];
        raise_floor(floors[at[j] + k], square);
      }
    }
  }
}

void append_vanished(const Front& front, std::span<const Index> frontals, std::span<const int> dim,
                     std::vector<Index>& variables) {
  int row = 0;
  for (Index j : frontals) {
    bool dropped = false;
    for (int k = 0; k < dim[j]; ++k, ++row) dropped |= !(front.pivot(row) > 0);
    if (dropped) variables.push_back(j);
  }
}

}  // namespace sg::solve
