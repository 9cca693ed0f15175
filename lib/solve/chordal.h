// The chordal relaxation: rotations that no rotation before them has to be known for.
//
// A pose graph is hard because of its rotations: given these, errors are linear in places. Edges measure
//     R_j = R_i Z,    t_j = t_i + R_i z
// which is linear in the numbers of all [R t] if one forgets that R are rotations, and splits into one problem for every
// row of them, with one and the same matrix. So the start is found in steps:
//
//   1  Over all matrices,
//          F = sum of  w/2 |R_j - R_i Z|^2 + v |t_j - t_i - R_i z|^2
//      (Frobenius' norm; w and v are an edge's information of turns and of places) is minimized: one sparse system. Each
//      R is brought to the nearest rotation (by its singular values).
//   2  Noise shrinks the matrices, the more the farther they are from what is held, until rounding is all that is left of
//      them. So for a few rounds, with P the rotations of the last,
//          F + sum of  u |R_j - P_j|^2
//      is minimized and R projected again: one factorization for all rounds. It is an inverse iteration, or proximal
//      steps, with the constraint met after each.
//   3  With rotations as they are, the rest is linear and solved for with all information: places of poses, and of
//      landmarks that edges measure as points (places.h).
//   4  What is left is placed by its edges (initialize.h): landmarks seen along rays are triangulated.
//
// Without noise 1 is exact. Landmarks that are measured as points close loops in 1 as poses do, and where translations
// say more of a turn than the rotations that were measured, they count for more. In the plane and in space alike.
//
// Parts of the graph that no measured motion joins to what is held stay where their first pose is.
//
// Sources: Martinec, Pajdla, Robust rotation and translation estimation in multiview reconstruction, CVPR 2007; Carlone,
// Tron, Daniilidis, Dellaert, Initialization techniques for 3D SLAM, ICRA 2015: they take w's terms alone. Rosen, Carlone,
// Bandeira, Leonard, SE-Sync, IJRR 2019: F, whose relaxation is convex in R'R. Boumal, Nonconvex phase synchronization,
// SIAM J. Optim. 2016, projects after each of a power method's steps; here they are inverse ones.
#pragma once

#include "lib/factor/problem.h"

namespace sg::solve {

constexpr int most_rounds = 10;
constexpr double pull = 0.1;      // u, of the mean information of turns that is measured at a pose
constexpr double settled = 1e-3;  // root of the mean |R - P|^2 that calls for no other round

// Steps 1 and 2: turns poses where they stand; the rest of `values` stays. Throws least_squares.h's Error.
void relax_rotations(const factor::Problem& problem, factor::Values& values);

}  // namespace sg::solve
