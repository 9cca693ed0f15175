// Places, with rotations as they are: errors of edges that measure where one thing stands, or from another, are linear in
// them, and one linear system finds them all.
#pragma once

#include <vector>

#include "lib/factor/problem.h"

namespace sg::solve {

// Moves poses and landmarks to where the sum of e' W e of such edges is least; in parts that nothing holds, the first pose
// stays. Marks in `placed` what such edges measure. Throws least_squares.h's Error.
void solve_places(const factor::Problem& problem, std::vector<bool>& placed,
                  factor::Values& values);

}  // namespace sg::solve
