// Landmarks seen from poses in space, through a sensor at offset p: with l' = (x p)^-1 l and the
// camera matrix K
//   EDGE_SE3_TRACKXYZ       e = l' - z
//   EDGE_PROJECT_DISPARITY  e = (u/w, v/w, 1/w) - z,  (u, v, w) = K l'
//   EDGE_PROJECT_DEPTH      e = (u/w, v/w, w) - z
// A step (u, v) of x moves x^-1 l by -u + 2 [x^-1 l]x v.
#pragma once

#include "lib/factor/model.h"
#include "lib/geometry/numbers.h"

namespace sg::factor {

// x^-1 l.
inline Eigen::Vector3d in_frame(const double* x, const double* landmark) {
  const SE3 pose = geometry::se3(x);
  return pose.q.conjugate() * (geometry::vector3(landmark) - pose.t);
}

// (x p)^-1 l, with the product's translation formed first: a quaternion that text has rounded makes
// a difference, and g2o's chi-square is the number to give.
inline Eigen::Vector3d in_sensor(const double* x, const SE3& p, const double* landmark) {
  const SE3 pose = geometry::se3(x);
  const Eigen::Vector3d origin = pose.q * p.t + pose.t;
  return p.q.conjugate() * (pose.q.conjugate() * (geometry::vector3(landmark) - origin));
}

// Jacobians of f((x p)^-1 l), with `slope` the Jacobian of f and `local` = x^-1 l.
inline void set_point_jacobians(const Eigen::Matrix3d& slope, const double* x, const SE3& p,
                                const Eigen::Vector3d& local, double* const* J) {
  const Eigen::Matrix3d turned = slope * p.q.conjugate().toRotationMatrix();
  Eigen::Map<Eigen::Matrix<double, 3, 6>> pose(J[0]);
  pose.leftCols<3>() = -turned;
  pose.rightCols<3>() = 2 * turned * geometry::skew(local);
  Eigen::Map<Eigen::Matrix3d>{J[1]} = turned * geometry::se3(x).q.conjugate().toRotationMatrix();
}

template <>
struct EdgeModel<graph::EdgeTag::se3_trackxyz> : Registered<graph::EdgeTag::se3_trackxyz> {
  static constexpr int constants = 10;

  // c = z, p
  static bool prepare(const double* z, const double* const* p, double* c) {
    std::copy_n(z, 3, c);
    set_se3(geometry::se3(p[0]), c + 3);
    return true;
  }

  static void evaluate(const double* const* x, const double* c, double* e, double* const* J) {
    const SE3 p = geometry::se3(c + 3);
    Eigen::Map<Eigen::Vector3d>{e} = in_sensor(x[0], p, x[1]) - geometry::vector3(c);
    if (!J) return;
    set_point_jacobians(Eigen::Matrix3d::Identity(), x[0], p, in_frame(x[0], x[1]), J);
  }

  static bool place(const double* const* x, const double* c, int end, double* out) {
    if (end != 1) return false;
    Eigen::Map<Eigen::Vector3d>{out} =
        act(geometry::se3(x[0]), act(geometry::se3(c + 3), geometry::vector3(c)));
    return true;
  }
};

// What a pixel (u, v) and a depth say together. Third: the third number of the measurement as a
// function of depth, its derivative, and its inverse.
template <graph::EdgeTag type, class Third>
struct PixelDepth : Registered<type> {
  static constexpr int constants = 14;

  // c = z, p, fx fy cx cy
  static bool prepare(const double* z, const double* const* p, double* c) {
    std::copy_n(z, 3, c);
    set_se3(geometry::se3(p[0]), c + 3);
    std::copy_n(p[0] + 7, 4, c + 10);
    return true;
  }

  static void evaluate(const double* const* x, const double* c, double* e, double* const* J) {
    const SE3 p = geometry::se3(c + 3);
    const double fx = c[10], fy = c[11], cx = c[12], cy = c[13];
    const Eigen::Vector3d seen = in_sensor(x[0], p, x[1]);
    const double w = seen[2], u = seen[0] / w, v = seen[1] / w;
    e[0] = fx * u + cx - c[0];
    e[1] = fy * v + cy - c[1];
    e[2] = Third::of_depth(w) - c[2];
    if (!J) return;
    const Eigen::Matrix3d slope{
        {fx / w, 0, -fx * u / w}, {0, fy / w, -fy * v / w}, {0, 0, Third::slope(w)}};
    set_point_jacobians(slope, x[0], p, in_frame(x[0], x[1]), J);
  }

  static bool place(const double* const* x, const double* c, int end, double* out) {
    const double w = Third::to_depth(c[2]);
    if (end != 1 || !std::isfinite(w)) return false;
    const Eigen::Vector3d seen(w * (c[0] - c[12]) / c[10], w * (c[1] - c[13]) / c[11], w);
    Eigen::Map<Eigen::Vector3d>{out} = act(geometry::se3(x[0]), act(geometry::se3(c + 3), seen));
    return true;
  }
};

struct DisparityOfDepth {
  static double of_depth(double w) { return 1 / w; }
  static double slope(double w) { return -1 / (w * w); }
  static double to_depth(double disparity) { return 1 / disparity; }
};
struct DepthOfDepth {
  static double of_depth(double w) { return w; }
  static double slope(double) { return 1; }
  static double to_depth(double depth) { return depth; }
};
template <>
struct EdgeModel<graph::EdgeTag::project_disparity>
    : PixelDepth<graph::EdgeTag::project_disparity, DisparityOfDepth> {};
template <>
struct EdgeModel<graph::EdgeTag::project_depth>
    : PixelDepth<graph::EdgeTag::project_depth, DepthOfDepth> {};

}  // namespace sg::factor
