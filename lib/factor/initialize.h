// Initial estimates where the file has none, or where they are to be ignored.
//
// Poses are composed along edges between poses, the predecessor's odometry first, from those that
// are constants or held, and stay where the file has them: the gauge is held where estimates are
// composed from. Another component starts at the first of its poses that a prior places, else its
// first pose stays where the file has it, or at the origin. A landmark stands where its first observation
// that tells puts it; from bearings and pixels alone it is triangulated: the point with the least
// sum of squared distances to the lines of sight (Hartley, Sturm: Triangulation, 1997, the linear
// method on normalized rays); a single line of sight, or nearly parallel ones, put it at a range of
// `lone_range` from the first observer.
#pragma once

#include <span>
#include <vector>

#include "lib/factor/problem.h"

namespace sg::factor {

constexpr double lone_range = 2;

// Estimates of every vertex, from the edges alone.
struct Composed {
  Values values;
  std::vector<Index> adrift;  // vertices that no edge places beside those before them: where they
                              // start says nothing
};
Composed compose(const Problem& problem);
// Goes on from the vertices that are marked: places all others, marks them, and returns those adrift.
std::vector<Index> place_rest(const Problem& problem, std::vector<bool>& placed, Values& values);
Values initial_values(const Problem& problem);  // without telling

// The file's estimates where it has VERTEX lines, initial_values otherwise: where every solver
// starts.
Values start_values(const Problem& problem);

// The ray along which edge e, of a type that has one, sees its landmark.
Ray ray_of(const Problem& problem, Index e, const Values& values);
// The point nearest to all rays, in `dim` dimensions, if they meet at an angle and ahead of every
// observer.
bool triangulate(std::span<const Ray> rays, int dim, double* out);

// Places vertex v by those of `edges` (edges at v, in order of preference) whose other ends are
// placed. False, and values untouched, where none of them tells.
bool place_vertex(const Problem& problem, Index v, std::span<const Index> edges,
                  const std::vector<bool>& placed, Values& values);

}  // namespace sg::factor
