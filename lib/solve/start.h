// Where to start: a table of ways to make estimates.
//
//   file      the file's own
//   odometry  composed along odometry, landmarks by their first observations (initialize.h)
//   chordal   rotations by the chordal relaxation, then what is linear (chordal.h)
//   tree      composed along the spanning tree of least uncertainty: every pose by the path on which the variances of
//             rotations sum up to least (Dijkstra, 1959), for it is rotations that carry far
//   isam2     what a pass of iSAM2 over the steps of the replay leaves (isam2_replay.h)
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "lib/factor/problem.h"

namespace sg::solve {

struct Start {
  std::string_view name;
  factor::Values (*make)(const factor::Problem& problem);
};

std::span<const Start> starts();
// Throws a usage Error that lists the names.
const Start& find_start(std::string_view name);
std::string start_names();  // "a, b"
// The name of a graph's own: its estimates, or of edges alone what odometry makes of them.
std::string_view own_start(const Graph& graph);

factor::Values chordal_start(const factor::Problem& problem);
factor::Values tree_start(const factor::Problem& problem);
factor::Values isam2_start(const factor::Problem& problem);

}  // namespace sg::solve
