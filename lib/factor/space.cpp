#include "lib/factor/space.h"

#include <algorithm>

#include "lib/geometry/numbers.h"

namespace sg {
namespace {

Vector6d vector6(const double* x) {
  return Eigen::Map<const Vector6d>(x);
}

}  // namespace

void retract(Space space, const double* step, double* x) {
  switch (space) {
    case Space::se2:
      x[0] += step[0];
      x[1] += step[1];
      x[2] = wrap(x[2] + step[2]);
      break;
    case Space::se3:
      set_se3(normalized(compose(se3(x), from_compact(vector6(step)))), x);
      break;
    case Space::expmap:
      set_se3(normalized(compose(exp(swapped(vector6(step))), se3(x))), x);
      break;
    case Space::xy:
    case Space::xyz:
      for (int k = 0; k < space_dim(space); ++k) x[k] += step[k];
      break;
    default:
      break;  // no steps
  }
}

void set_origin(Space space, double* x) {
  std::fill_n(x, space_size(space), 0.0);
  if (space == Space::se3 || space == Space::expmap) x[6] = 1;
}

bool from_file(Space space, const double* numbers, double* x) {
  std::copy_n(numbers, space_size(space), x);
  if (space != Space::se3 && space != Space::expmap) return true;
  if (se3(x).q.norm() < 1e-6) return false;
  if (space == Space::expmap) set_se3(inverse(normalized(se3(x))), x);
  return true;
}

void to_file(Space space, const double* x, double* numbers) {
  std::copy_n(x, space_size(space), numbers);
  if (space == Space::expmap) set_se3(inverse(se3(x)), numbers);
}

}  // namespace sg
