#include "lib/factor/space.h"

#include <algorithm>

#include "lib/geometry/numbers.h"

namespace sg::factor {
namespace {

// Whether an estimate is the inverse of the pose in its line.
bool maps_to_camera(graph::Space space) {
  return space == graph::Space::expmap || space == graph::Space::bal_camera;
}

Vector6d vector6(const double* x) {
  return Eigen::Map<const Vector6d>(x);
}

}  // namespace

void retract(graph::Space space, const double* step, double* x) {
  switch (space) {
    case graph::Space::se2:
      x[0] += step[0];
      x[1] += step[1];
      x[2] = geometry::wrap(x[2] + step[2]);
      break;
    case graph::Space::se3:
      set_se3(normalized(compose(geometry::se3(x), geometry::from_compact(vector6(step)))), x);
      break;
    case graph::Space::bal_camera:
      for (int k = 0; k < 3; ++k) x[7 + k] += step[6 + k];
      [[fallthrough]];
    case graph::Space::expmap:
      set_se3(
          normalized(compose(geometry::exp(geometry::swapped(vector6(step))), geometry::se3(x))),
          x);
      break;
    case graph::Space::xy:
    case graph::Space::xyz:
      for (int k = 0; k < graph::space_dim(space); ++k) x[k] += step[k];
      break;
    default:
      break;  // no steps
  }
}

void set_origin(graph::Space space, double* x) {
  std::fill_n(x, graph::space_size(space), 0.0);
  if (graph::has_quaternion(space)) x[6] = 1;
  if (space == graph::Space::bal_camera) x[7] = 1;
}

bool from_file(graph::Space space, const double* numbers, double* x) {
  std::copy_n(numbers, graph::space_size(space), x);
  if (!graph::has_quaternion(space)) return true;
  if (geometry::se3(x).q.norm() < 1e-6) return false;
  if (maps_to_camera(space)) set_se3(inverse(normalized(geometry::se3(x))), x);
  return true;
}

void to_file(graph::Space space, const double* x, double* numbers) {
  std::copy_n(x, graph::space_size(space), numbers);
  if (maps_to_camera(space)) set_se3(inverse(geometry::se3(x)), numbers);
}

}  // namespace sg::factor
