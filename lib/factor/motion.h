// What edges say of motions, whatever their type: what starts are made of.
//
// [R t] takes a pose's own frame to the world's, of poses that map world to camera as well; a pose of the plane turns
// about z. A landmark has no R.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "lib/factor/problem.h"

namespace sg::factor {

// Of an edge from i to j:  R_j = R_i R,  t_j = t_i + R_i t.  Of one of j alone, and between landmarks: R_i = I, and of
// the former t_i = 0.
struct Motion {
  Eigen::Matrix3d R;
  Eigen::Vector3d t;
  double
      turn_information;  // of R in radians, and of t: the mean over the axes, all else being known; 0: it says
  double place_information;  // nothing of it
};

// Nothing for an edge that measures otherwise: bearings, pixels, a prior of a place alone.
std::optional<Motion> measured_motion(const Problem& problem, Index e);

Eigen::Matrix3d rotation(const Problem& problem, const Values& values, Index v);
// Turns the pose where it stands.
void set_rotation(const Problem& problem, Index v, const Eigen::Matrix3d& R, Values& values);
Eigen::Vector3d translation(const Problem& problem, const Values& values, Index v);

}  // namespace sg::factor
