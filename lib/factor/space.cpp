#include "lib/factor/space.h"

#include <algorithm>
#include <cmath>

#include "lib/factor/estimate.h"
#include "lib/geometry/se2.h"

namespace sg {
namespace {

SE3 normalized(SE3 x) {
  x.q.normalize();
  return x;
}

// A step whose vector part is longer than 1 is no unit quaternion: it turns by pi about that axis.
SE3 quaternion_step(const double* step) {
  SE3 d;
  d.t = vector3(step);
  d.q.vec() = vector3(step + 3);
  d.q.w() = std::sqrt(std::max(0.0, 1 - d.q.vec().squaredNorm()));
  return d;
}

SE3 expmap_step(const double* step) {
  Vector6d v;
  v << vector3(step + 3), vector3(step);
  return exp(v);
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
      set_se3(normalized(compose(se3(x), quaternion_step(step))), x);
      break;
    case Space::expmap:
      set_se3(normalized(compose(expmap_step(step), se3(x))), x);
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
