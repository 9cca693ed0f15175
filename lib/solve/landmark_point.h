// Where to linearize a landmark that is seen along rays: pixels, bearings.
//
// Seen from nearby poses, its distance is what the rays hardly tell, and a Gauss-Newton step may
// carry it far away or behind an observer, where linearizing says nothing of it any more. Batch
// solvers damp such steps; an incremental one has to choose its linearization points well.
#pragma once

#include <span>

#include "lib/factor/problem.h"

namespace sg::solve {

// Whether an edge sees a landmark along a ray.
bool sees_along_ray(const factor::Problem& problem, Index e);

// How far along its ray edge e has its landmark at `values`, negative behind the observer. A
// measurement cannot be linearized at the lens or behind it (no camera sees there): below
// `nearest_seen` it had better be left out.
double ray_distance(const factor::Problem& problem, Index e, const factor::Values& values);
constexpr double nearest_seen = 0.1;

// Information that damps the landmark's step along such an edge: that of a step as long as its
// distance. It keeps elimination regular where rays are nearly parallel or left out, and it
// vanishes with the step.
double ray_damping(double distance);

// Moves the linearization point of landmark v (dim numbers): by the step from it, at most to where
// that halves or doubles a distance, or to the triangulation of all rays, whichever gives its edges
// the lesser chi-square with all other vertices at `estimate`. It stays where it is if that is
// better still, or if both lie behind an observer. `edges`: those at v that have entered. The
// estimate of v is scratch.
void move_landmark(const factor::Problem& problem, Index v, std::span<const Index> edges,
                   std::span<const double> step, factor::Values& estimate, double* point);

}  // namespace sg::solve
