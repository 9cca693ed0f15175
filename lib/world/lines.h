// Lines of pose graphs, in SE(2) and in SE(3), and the noise of relative pose measurements.
//
// The error of a measurement z between poses a and b is  d = z^-1 a^-1 b  as g2o has it: (x, y,
// theta) for EDGE_SE2; for EDGE_SE3:QUAT the translation and the vector part of the quaternion,
// which is half the rotation vector. So a rotation of standard deviation s about each axis has the
// information 1/s^2 in the plane and 4/s^2 in space. For Gaussian noise of equal size along all
// axes, z = (a^-1 b) n and z^-1 (a^-1 b) = n^-1 have the same distribution: what is drawn here is
// what the information claims.
#pragma once

#include "lib/geometry/se2.h"
#include "lib/geometry/se3.h"
#include "lib/world/out.h"
#include "lib/world/random.h"

namespace sg::world {

// Standard deviations of a relative pose measurement.
struct PoseNoise {
  double translation;  // metres along each axis
  double rotation;     // radians about each axis
};

// The pose that the text will say, cf. `rounded` of a number; a quaternion with w >= 0.
SE2 rounded(const SE2& pose);
SE3 rounded(const SE3& pose);

// z n with n drawn from `noise`, rounded.
SE2 disturbed(const SE2& z, const PoseNoise& noise, Random& random);
SE3 disturbed(const SE3& z, const PoseNoise& noise, Random& random);

// VERTEX_SE2 x y theta; VERTEX_SE3:QUAT x y z qx qy qz qw.
void vertex_line(Out& out, Id vertex, const SE2& pose);
void vertex_line(Out& out, Id vertex, const SE3& pose);

// EDGE_SE2 and EDGE_SE3:QUAT with diagonal information.
void edge_line(Out& out, Id a, Id b, const SE2& z, const PoseNoise& noise);
void edge_line(Out& out, Id a, Id b, const SE3& z, const PoseNoise& noise);

// The numbers alone: those of a pose, and the upper triangle of an information matrix, row by row.
void numbers(Out& out, const SE2& pose);
void numbers(Out& out, const SE3& pose);
void diagonal_information(Out& out, const double* diagonal, int size);

}  // namespace sg::world
