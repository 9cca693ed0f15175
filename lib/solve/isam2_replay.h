// A graph replayed step by step (lib/graph/replay.h) through iSAM2.
//
// A step's new vertices start from the current estimate: poses composed along odometry, else along
// another edge of the step; then landmarks and others from their observations (initialize.h). A
// vertex that no edge of its step places starts where the file has it, or at the origin; so do fixed
// vertices, which are constants, and the one that holds the gauge.
#pragma once

#include <vector>

#include "lib/graph/lists.h"
#include "lib/graph/replay.h"
#include "lib/solve/isam2.h"

namespace sg::solve {

struct Isam2Replay {
  const factor::Problem* problem = nullptr;  // outlives it
  bool start_from_file = false;              // all vertices start where the file has them
  factor::Values file;  // start_values without; of a file without estimates: empty
  graph::PoseIndex poses;
  graph::Replay steps;
  graph::Lists<> vertices;  // by step
  graph::Lists<> edges;     // by step
  std::vector<bool> placed;
  Isam2 isam;
};

// -1 of a constant.
inline Index variable_of(const Isam2Replay& replay, Index v) {
  return replay.problem->variables.vertex_variable[v];
}

// start_from_file needs a file with estimates; throws an input Error otherwise.
Isam2Replay make_isam2_replay(const factor::Problem& problem, const Isam2Options& options,
                              int min_obs, bool start_from_file);
Isam2Replay make_isam2_replay(const factor::Problem&&, const Isam2Options&, int, bool) = delete;

// What enters: vertices with their starts, edges with rows of their own.
struct Entering {
  std::vector<Index> variables, rows;
};
// Starts vertices from what is there and these edges, poses first; rows are those of edges that hold a variable,
// with the gauge's where the variable that it holds enters.
Entering enter(Isam2Replay& replay, std::span<const Index> vertices, std::span<const Index> edges);

// Throws the Error that replay_step throws where step k could not be solved.
void check_solved(const Isam2Replay& replay, Index k, const Isam2Report& report);

// Step k, after 0 .. k - 1. Throws a computation Error that names the step and the undetermined
// vertices if it cannot be solved, and those of check_row (linearize.h).
Isam2Report replay_step(Isam2Replay& replay, Index k);

}  // namespace sg::solve
