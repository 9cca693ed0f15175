#include "lib/factor/relative.h"

#include <algorithm>

#include "lib/factor/edge_se3.h"
#include "lib/geometry/numbers.h"

namespace sg::factor {
namespace {

using graph::Space;

// Text rounds quaternions (edge_se3.h): brought to unit length, an estimate is where its own text says.
SE3 pose_of(const double* x) {
  return normalized(geometry::se3(x));
}

bool is_camera(Space space) {
  return space == Space::expmap || space == Space::bal_camera;
}

// Of a step (translation, vector part of a quaternion) beyond z: z d' = d z.
Matrix6d compact_adjoint(const SE3& z) {
  Matrix6d A = adjoint(z);
  A.topRightCorner<3, 3>() *= 2;
  A.bottomLeftCorner<3, 3>() /= 2;
  return A;
}

void set_seen(const Eigen::Vector3d& point, Seen& seen) {
  std::copy_n(point.data(), 3, seen.z.data());
}

void see_in_plane(const double* pose, Space space, const double* x, Seen& seen) {
  const int dim = graph::space_dim(space);
  const Eigen::Matrix2d back = geometry::rotation(-pose[2]);
  const Eigen::Vector2d z = back * (geometry::vector2(x) - geometry::vector2(pose));
  seen.z[0] = z[0];
  seen.z[1] = z[1];
  seen.of_x.topLeftCorner(2, 2) = back;
  seen.of_pose.topLeftCorner(2, 2) = -back;
  seen.of_pose(0, 2) = z[1];
  seen.of_pose(1, 2) = -z[0];
  if (dim < 3) return;
  seen.z[2] = geometry::wrap(x[2] - pose[2]);
  seen.of_pose(2, 2) = -1;
}

void see_in_space(const double* pose, Space space, const double* x, Seen& seen) {
  const SE3 from = pose_of(pose);
  if (space == Space::xyz) {
    const Eigen::Vector3d z = act(inverse(from), geometry::vector3(x));
    set_seen(z, seen);
    seen.of_x = from.q.conjugate().toRotationMatrix();
    seen.of_pose.leftCols(3) = -Eigen::Matrix3d::Identity();
    seen.of_pose.rightCols(3) = 2 * geometry::skew(z);
    return;
  }
  const SE3 z = between(from, pose_of(x));
  set_se3(z, seen.z.data());
  seen.of_pose = -compact_adjoint(inverse(z));
}

void see_by_camera(const double* pose, Space space, const double* x, Seen& seen) {
  const SE3 camera = pose_of(pose);
  if (space == Space::xyz) {
    const Eigen::Vector3d z = act(camera, geometry::vector3(x));
    set_seen(z, seen);
    seen.of_x = camera.q.toRotationMatrix();
    seen.of_pose.leftCols(3) = -geometry::skew(z);
    seen.of_pose.middleCols(3, 3) = Eigen::Matrix3d::Identity();
    return;
  }
  std::copy_n(x, graph::space_size(space), seen.z.data());
  const SE3 z = compose(pose_of(x), inverse(camera));
  set_se3(z, seen.z.data());
  seen.of_pose.topLeftCorner(6, 6) = -geometry::swapped(adjoint(z));
}

}  // namespace

Difference difference(Space space, const double* x0, const double* x) {
  const int dim = graph::space_dim(space);
  Difference result{Step(dim), Slope::Identity(dim, dim)};
  if (space == Space::se3) {
    const SE3 d = between(pose_of(x0), pose_of(x));
    result.step = compact(d);
    set_jacobian(d, SE3{}, 1, result.slope.data());
    return result;
  }
  if (is_camera(space)) {
    const Vector6d moved = geometry::log(compose(pose_of(x), inverse(pose_of(x0))));
    result.step.head(6) = geometry::swapped(moved);
    result.slope.topLeftCorner(6, 6) = geometry::swapped(geometry::inverse_left_jacobian(moved));
    for (int k = 6; k < dim; ++k) result.step[k] = x[k + 1] - x0[k + 1];
    return result;
  }
  for (int k = 0; k < dim; ++k) result.step[k] = x[k] - x0[k];
  if (space == Space::se2) result.step[2] = geometry::wrap(result.step[2]);
  return result;
}

bool sees(Space pose, Space space) {
  if (pose == Space::se2) return space == Space::se2 || space == Space::xy;
  if (pose == Space::se3) return space == Space::se3 || space == Space::xyz;
  return is_camera(pose) && (is_camera(space) || space == Space::xyz);
}

Seen seen_from(Space from, const double* pose, Space space, const double* x) {
  const int dim = graph::space_dim(space);
  Seen seen{{}, Slope::Zero(dim, graph::space_dim(from)), Slope::Identity(dim, dim)};
  if (from == Space::se2) {
    see_in_plane(pose, space, x, seen);
  } else if (from == Space::se3) {
    see_in_space(pose, space, x, seen);
  } else {
    see_by_camera(pose, space, x, seen);
  }
  return seen;
}

void place_seen(Space from, const double* pose, Space space, const double* z, double* x) {
  if (from == Space::se2) {
    const SE2 at = geometry::se2(pose);
    const Eigen::Vector2d p = act(at, geometry::vector2(z));
    std::copy_n(p.data(), 2, x);
    if (space == Space::se2) x[2] = geometry::wrap(at.theta + z[2]);
    return;
  }
  const SE3 own = pose_of(pose);
  const SE3 at = from == Space::se3 ? own : inverse(own);
  if (space == Space::xyz) {
    const Eigen::Vector3d p = act(at, geometry::vector3(z));
    std::copy_n(p.data(), 3, x);
    return;
  }
  std::copy_n(z, graph::space_size(space), x);
  set_se3(from == Space::se3 ? compose(at, pose_of(z)) : compose(pose_of(z), own), x);
}

}  // namespace sg::factor
