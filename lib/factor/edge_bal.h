// Bundle adjustment in the large (BAL): cameras with a focal length and two terms of radial distortion
// of their own.
//   EDGE_OBSERVATION_BAL   e = f r(|p|^2) p - z,   r(n) = 1 + k1 n + k2 n^2,
//                          p = -(P_x, P_y) / P_z the landmark P = E l as the camera sees it
// The estimate E maps world to camera (space bal_camera); the camera looks along its negative z axis,
// and z is in pixels from the centre of the image.
//
// Source: Agarwal, Snavely, Seitz, Szeliski, Bundle Adjustment in the Large (ECCV 2010).
#pragma once

#include <cmath>

#include "lib/factor/edge_expmap.h"

namespace sg::factor {

// The radius that distortion makes `distorted`, by Newton's method; where there is none, that itself.
inline double undistorted(double distorted, double k1, double k2) {
  double radius = distorted;
  for (int k = 0; k < 20; ++k) {
    const double n = radius * radius;
    const double error = radius * (1 + n * (k1 + n * k2)) - distorted;
    if (std::abs(error) <= 1e-15 * distorted) return radius;
    radius -= error / (1 + n * (3 * k1 + n * 5 * k2));
  }
  const double n = radius * radius;
  const double error = radius * (1 + n * (k1 + n * k2)) - distorted;
  return radius > 0 && std::abs(error) < 1e-9 * distorted ? radius : distorted;
}

template <>
struct EdgeModel<graph::EdgeTag::observation_bal> : Registered<graph::EdgeTag::observation_bal> {
  static constexpr int constants = 2;

  static bool prepare(const double* z, const double* const*, double* c) {
    std::copy_n(z, constants, c);
    return true;
  }

  static void evaluate(const double* const* x, const double* c, double* e, double* const* J) {
    const SE3 pose = geometry::se3(x[0]);
    const double f = x[0][7], k1 = x[0][8], k2 = x[0][9];
    const Eigen::Vector3d seen = act(pose, geometry::vector3(x[1]));
    const Eigen::Vector2d p = -seen.head<2>() / seen[2];
    const double n = p.squaredNorm(), r = 1 + n * (k1 + n * k2);
    Eigen::Map<Eigen::Vector2d>{e} = f * r * p - geometry::vector2(c);
    if (!J) return;
    const Eigen::Matrix2d distortion =
        f * (r * Eigen::Matrix2d::Identity() + 2 * (k1 + 2 * n * k2) * p * p.transpose());
    Eigen::Matrix<double, 2, 3> projection;
    projection << Eigen::Matrix2d::Identity(), p;
    carry_back<2>(distortion * projection / -seen[2], pose, seen, J[1], J[0]);
    Eigen::Map<Eigen::Matrix<double, 2, 9>> camera(J[0]);
    camera.rightCols<3>() << r * p, f * n * p, f * n * n * p;
  }

  static Ray rays(const double* const* x, const double* c) {
    const Eigen::Vector2d distorted = geometry::vector2(c) / x[0][7];
    const double m = distorted.norm();
    const double share = m > 0 ? undistorted(m, x[0][8], x[0][9]) / m : 1;
    return ray_along(geometry::se3(x[0]), {share * distorted[0], share * distorted[1], -1});
  }
};

}  // namespace sg::factor
