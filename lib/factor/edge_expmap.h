// Poses and cameras whose estimate E maps world to camera (space expmap), E := exp(step) E, step =
// (rotation, translation). A line holds camera-to-world poses, hence c = z^-1 for relative poses.
//   EDGE_SE3:EXPMAP                    e = log(E_j^-1 z^-1 E_i), rotation first
//   EDGE_PROJECT_XYZ2UV:EXPMAP         e = z - pixel of E l, (u, v)
//   EDGE_PROJECT_XYZ2UVU:EXPMAP        e = z - (u, v, u in a right camera at `baseline`)
//   EDGE_SE3_PROJECT_XYZ:EXPMAP        as XYZ2UV with fx fy cx cy at the line's end
//   EDGE_STEREO_SE3_PROJECT_XYZ:EXPMAP as XYZ2UVU with fx fy cx cy and bf = fx * baseline at the
//                                      line's end
// A step (w, t) moves E l by w x E l + t.
#pragma once

#include "lib/factor/model.h"
#include "lib/geometry/numbers.h"

namespace sg::factor {

// g2o takes sin(angle) for the angle where cos(angle) > 0.99999, and its chi-square is the number
// to give.
inline Eigen::Vector3d g2o_log_so3(const Eigen::Quaterniond& q) {
  const double cosine = 1 - 2 * q.vec().squaredNorm();
  if (cosine > 0.99999) return 2 * q.w() * q.vec();
  return geometry::log_so3(q);
}

template <>
struct EdgeModel<graph::EdgeTag::expmap> : Registered<graph::EdgeTag::expmap> {
  static constexpr int constants = 7;

  static bool prepare(const double* z, const double* const*, double* c) {
    return from_file(graph::Space::expmap, z, c);
  }

  static void evaluate(const double* const* x, const double* c, double* e, double* const* J) {
    const SE3 back = inverse(geometry::se3(x[1]));
    const SE3 to = compose(back, geometry::se3(c));
    const SE3 d = compose(to, geometry::se3(x[0]));
    const Eigen::Vector3d w = g2o_log_so3(d.q);
    Vector6d error;
    error << geometry::inverse_left_jacobian_so3(w) * d.t, w;
    Eigen::Map<Vector6d>{e} = geometry::swapped(error);
    if (!J) return;
    const Matrix6d slope = geometry::inverse_left_jacobian(error);
    Eigen::Map<Matrix6d>{J[0]} = geometry::swapped(Matrix6d(slope * adjoint(to)));
    Eigen::Map<Matrix6d>{J[1]} = geometry::swapped(Matrix6d(-slope * adjoint(back)));
  }

  static bool place(const double* const* x, const double* c, int end, double* out) {
    const SE3 z = geometry::se3(c);
    set_se3(end == 1 ? compose(z, geometry::se3(x[0])) : compose(inverse(z), geometry::se3(x[1])),
            out);
    return true;
  }
};

// A pinhole camera; `shift` = focal length * baseline separates the right image's u from the
// left's.
struct Pinhole {
  double fx, fy, cx, cy, shift;
};

// The Jacobians, in the landmark and in the six first scalars of the camera's step, of an error with
// this slope in the landmark as the camera sees it.
template <int dim>
void carry_back(const Eigen::Matrix<double, dim, 3>& slope, const SE3& pose,
                const Eigen::Vector3d& seen, double* landmark, double* camera) {
  Eigen::Map<Eigen::Matrix<double, dim, 3>>{landmark} = slope * pose.q.toRotationMatrix();
  Eigen::Map<Eigen::Matrix<double, dim, 6>> of_step(camera);
  of_step.template leftCols<3>() = -slope * geometry::skew(seen);
  of_step.template rightCols<3>() = slope;
}

// The error of the first `dim` of (u, v, u_right), and its Jacobians in the landmark and the pose.
template <int dim>
void project(const double* const* x, const double* z, const Pinhole& camera, double* e,
             double* const* J) {
  const SE3 pose = geometry::se3(x[1]);
  const Eigen::Vector3d seen = act(pose, geometry::vector3(x[0]));
  const double w = seen[2], u = seen[0] / w, v = seen[1] / w;
  const Eigen::Vector3d pixel(camera.fx * u + camera.cx, camera.fy * v + camera.cy,
                              camera.fx * u + camera.cx - camera.shift / w);
  for (int k = 0; k < dim; ++k) e[k] = z[k] - pixel[k];
  if (!J) return;
  const Eigen::Matrix3d full{{-camera.fx / w, 0, camera.fx * u / w},
                             {0, -camera.fy / w, camera.fy * v / w},
                             {-camera.fx / w, 0, (camera.fx * u - camera.shift / w) / w}};
  carry_back<dim>(full.topRows<dim>(), pose, seen, J[0], J[1]);
}

// Where pixel (u, v) looks: a point at depth 1 of the camera's frame.
inline Eigen::Vector3d toward(const double* z, const Pinhole& camera) {
  return {(z[0] - camera.cx) / camera.fx, (z[1] - camera.cy) / camera.fy, 1};
}

// The ray from the camera's centre in a direction of its frame that does not lie in its plane. Its rows
// are two planes through the centre: those of a pixel's column and of its row.
inline Ray ray_along(const SE3& pose, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d axes[] = {{1, 0, -direction[0] / direction[2]},
                                  {0, 1, -direction[1] / direction[2]}};
  const SE3 to_world = inverse(pose);
  Ray ray;
  ray.rows = 2;
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector3d normal = to_world.q * axes[k].normalized();
    ray.row[k] = {normal[0], normal[1], normal[2], normal.dot(to_world.t)};
  }
  Eigen::Map<Eigen::Vector3d>{ray.origin.data()} = to_world.t;
  Eigen::Map<Eigen::Vector3d>{ray.ahead.data()} = (to_world.q * direction).normalized();
  return ray;
}

// c = z, then the camera. Camera::of makes it of the numbers behind the information and of the
// parameters.
template <graph::EdgeTag type, class Camera>
struct PixelEdge : Registered<type> {
  static constexpr int dim = Registered<type>::dim, constants = dim + 5;

  static bool prepare(const double* z, const double* const* p, double* c) {
    std::copy_n(z, dim, c);
    const Pinhole camera = Camera::of(z + dim, p);
    const double numbers[] = {camera.fx, camera.fy, camera.cx, camera.cy, camera.shift};
    std::copy_n(numbers, 5, c + dim);
    return true;
  }

  static Pinhole camera(const double* c) {
    return {c[dim], c[dim + 1], c[dim + 2], c[dim + 3], c[dim + 4]};
  }

  static void evaluate(const double* const* x, const double* c, double* e, double* const* J) {
    project<dim>(x, c, camera(c), e, J);
  }

  static bool place(const double* const* x, const double* c, int end, double* out) {
    if (dim < 3 || end != 0) return false;
    const double w = camera(c).shift / (c[0] - c[dim - 1]);
    if (!(w > 0) || !std::isfinite(w)) return false;
    Eigen::Map<Eigen::Vector3d>{out} = act(inverse(geometry::se3(x[1])), w * toward(c, camera(c)));
    return true;
  }

  static Ray rays(const double* const* x, const double* c) {
    return ray_along(geometry::se3(x[1]), toward(c, camera(c)));
  }
};

struct CameraParameter {
  static Pinhole of(const double*, const double* const* p) {
    return {p[0][0], p[0][0], p[0][1], p[0][2], p[0][0] * p[0][3]};
  }
};
struct MonoAtTheEnd {
  static Pinhole of(const double* extra, const double* const*) {
    return {extra[0], extra[1], extra[2], extra[3], 0};
  }
};
struct StereoAtTheEnd {
  static Pinhole of(const double* extra, const double* const*) {
    return {extra[0], extra[1], extra[2], extra[3], extra[4]};
  }
};

template <>
struct EdgeModel<graph::EdgeTag::project_xyz2uv>
    : PixelEdge<graph::EdgeTag::project_xyz2uv, CameraParameter> {};
template <>
struct EdgeModel<graph::EdgeTag::project_xyz2uvu>
    : PixelEdge<graph::EdgeTag::project_xyz2uvu, CameraParameter> {};
template <>
struct EdgeModel<graph::EdgeTag::se3_project_xyz>
    : PixelEdge<graph::EdgeTag::se3_project_xyz, MonoAtTheEnd> {};
template <>
struct EdgeModel<graph::EdgeTag::stereo_se3_project_xyz>
    : PixelEdge<graph::EdgeTag::stereo_se3_project_xyz, StereoAtTheEnd> {};

}  // namespace sg::factor
