// SE(3): rigid motions of space.
//
// x = (q, t) maps a point p of its own frame to  R(q) p + t.  Tangent vectors are (translation,
// rotation): three numbers each, the rotation a rotation vector in radians.
//
// Uncertainty, as g2o's EDGE_SE3:QUAT has it: a measurement z with information W says that the true
// motion is z d, where d = (dx, dy, dz, dqx, dqy, dqz), the vector part of a unit quaternion, ~
// N(0, W^-1) stands in z's end frame. To first order dq is half a rotation vector, so with S =
// diag(1, 1, 1, 2, 2, 2) and A(z) = S^-1 Ad(z) S
//     z1 d1 z2 d2 = (z1 z2) (A(z2^-1) d1 + d2),       (z d)^-1 = z^-1 (-A(z) d).
// Sources: Barfoot, State Estimation for Robotics (2017), chapter 7 (in which rotations stand last
// as here); Smith, Self, Cheeseman (1990).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace sg::geometry {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

struct SE3 {
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();  // of unit length
  Eigen::Vector3d t = Eigen::Vector3d::Zero();
};

SE3 compose(const SE3& a, const SE3& b);  // a b
SE3 inverse(const SE3& a);
SE3 between(const SE3& a, const SE3& b);  // a^-1 b
SE3 normalized(SE3 a);                    // its quaternion brought to unit length
Eigen::Vector3d act(const SE3& a, const Eigen::Vector3d& point);

// [v]x with [v]x w = v x w.
Eigen::Matrix3d skew(const Eigen::Vector3d& v);

// Ad(a) with a exp(v) a^-1 = exp(Ad(a) v).
Matrix6d adjoint(const SE3& a);
SE3 exp(const Vector6d& tangent);
Vector6d log(const SE3& a);  // inverse of exp for a rotation below pi

Eigen::Quaterniond exp_so3(const Eigen::Vector3d& rotation);
Eigen::Vector3d log_so3(const Eigen::Quaterniond& q);

// (translation, vector part of the quaternion), the coordinates of the errors and steps of g2o's
// QUAT types: of q and -q the one with w >= 0, and back. A vector part longer than 1 belongs to no
// unit quaternion: it turns by pi about that axis.
Vector6d compact(const SE3& a);
SE3 from_compact(const Vector6d& v);

// Rotation before translation, as g2o's EXPMAP types have it, and back.
Vector6d swapped(const Vector6d& v);
Matrix6d swapped(const Matrix6d& m);

// J^-1 with log(exp(v) exp(u)) = u + J^-1(u) v + O(v^2): the inverse left Jacobian (Barfoot 7.37
// and 7.95).
Eigen::Matrix3d inverse_left_jacobian_so3(const Eigen::Vector3d& rotation);
Matrix6d inverse_left_jacobian(const Vector6d& tangent);

// R = Rz(yaw) Ry(pitch) Rx(roll); angles in radians, of a quaternion of unit length. Near pitch =
// +-pi/2, where only roll -+ yaw is determined, they are split so that the rotation is the same.
Eigen::Quaterniond from_roll_pitch_yaw(double roll, double pitch, double yaw);
Eigen::Vector3d roll_pitch_yaw(const Eigen::Quaterniond& q);

// A measured motion with the information of EDGE_SE3:QUAT.
struct UncertainSE3 {
  SE3 mean;
  Matrix6d information;
};

// First-order propagation; a singular information (a direction of which nothing is known) stays
// singular.
UncertainSE3 compose(const UncertainSE3& a, const UncertainSE3& b);
UncertainSE3 inverse(const UncertainSE3& a);

}  // namespace sg::geometry

namespace sg {
using geometry::Matrix6d;
using geometry::SE3;
using geometry::Vector6d;
}  // namespace sg
