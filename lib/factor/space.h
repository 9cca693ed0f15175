// How a tangent step moves an estimate, and how a file's line becomes one.
//
// The steps are g2o's (`oplus`), so that Jacobians, information matrices and iterates compare with
// its own:
//   se2      (x, y, theta): added number by number, theta wrapped
//   se3      (x, y, z, qx, qy, qz, qw): x d, where d is the translation step[0..2] and the
//            quaternion with vector part step[3..5]
//   expmap   the same seven numbers: exp(step) x, step = (rotation, translation)
//   bal_camera  the same and (focal length, k1, k2): exp(step[0..5]) x, then three numbers added
//   xy, xyz  added
// An estimate of expmap and bal_camera maps world to camera; its file line holds the inverse.
// Quaternions have unit length in memory.
#pragma once

#include "lib/graph/types.h"

namespace sg::factor {

// Whether there are steps of this space here; the functions below take no other. An estimate has
// as many numbers in memory as in a vertex line.
constexpr bool has_steps(graph::Space space) {
  return space == graph::Space::se2 || space == graph::Space::se3 ||
         space == graph::Space::expmap || space == graph::Space::bal_camera ||
         space == graph::Space::xy || space == graph::Space::xyz;
}

// Whether a scalar of a step turns, in radians or halves of them; the others move, in metres.
constexpr bool is_turn(graph::Space space, int scalar) {
  const graph::Axes rotation = graph::facts(space).rotation;
  return rotation.first <= scalar && scalar < rotation.first + rotation.size;
}

// x := x (+) step.
void retract(graph::Space space, const double* step, double* x);

// Identity, the origin; a focal length of 1.
void set_origin(graph::Space space, double* x);

// A vertex line's numbers to an estimate and back. False for a quaternion of length zero.
bool from_file(graph::Space space, const double* numbers, double* x);
void to_file(graph::Space space, const double* x, double* numbers);

}  // namespace sg::factor
