// SE(2): rigid motions of the plane.
//
// x = (t, theta) maps a point p of its own frame to  R(theta) p + t.  Angles are in radians,
// wrapped to (-pi, pi]. Tangent vectors are (x, y, theta) throughout.
//
// Uncertainty, as g2o's EDGE_SE2 has it: a measurement z with information W says that the true
// motion is z d, where d = (dx, dy, dtheta) ~ N(0, W^-1) stands in z's end frame. To first order d
// is a tangent vector, hence
//     z1 d1 z2 d2 = (z1 z2) (Ad(z2^-1) d1 + d2),       (z d)^-1 = z^-1 (-Ad(z) d).
// Source: Smith, Self, Cheeseman: Estimating Uncertain Spatial Relationships in Robotics (1990),
// sections 3 and 4.
#pragma once

#include <Eigen/Core>

namespace sg::geometry {

struct SE2 {
  double x = 0;
  double y = 0;
  double theta = 0;
};

// The same angle in (-pi, pi].
double wrap(double angle);

SE2 compose(const SE2& a, const SE2& b);  // a b
SE2 inverse(const SE2& a);
SE2 between(const SE2& a, const SE2& b);  // a^-1 b
Eigen::Vector2d act(const SE2& a, const Eigen::Vector2d& point);
Eigen::Matrix2d rotation(double theta);

// Ad(a) with a exp(v) a^-1 = exp(Ad(a) v).
Eigen::Matrix3d adjoint(const SE2& a);
SE2 exp(const Eigen::Vector3d& tangent);
Eigen::Vector3d log(const SE2& a);  // inverse of exp for |theta| < pi

// A measured motion with the information of EDGE_SE2.
struct UncertainSE2 {
  SE2 mean;
  Eigen::Matrix3d information;
};

// First-order propagation; a singular information (a direction of which nothing is known) stays
// singular.
UncertainSE2 compose(const UncertainSE2& a, const UncertainSE2& b);
UncertainSE2 inverse(const UncertainSE2& a);

}  // namespace sg::geometry

namespace sg {
using geometry::SE2;
}  // namespace sg
