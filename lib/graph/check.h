// What is wrong with a graph that could be read. (What keeps a line from being read is the
// reader's to say.)
#pragma once

#include <string>
#include <vector>

#include "lib/graph/graph.h"

namespace sg::graph {

struct Finding {
  Offset line;  // `implied` where no line is meant
  bool error;   // else a warning
  std::string cause;
};

// Errors: numbers that are infinite or none, information that is not positive semidefinite,
// quaternions of length zero, edges that join a vertex to itself, landmarks that their observations
// cannot determine. Warnings: quaternions far from unit length, parts that nothing connects to the
// rest.
//
// A text holds the upper triangle of an information matrix only: it is symmetric as it stands. It
// counts as semidefinite down to an eigenvalue of -1e-9 times the largest. A quaternion is far from
// unit length by 1e-3.
//
// A landmark is determined if one measurement of it has its dimension, or if those from different
// vertices add up to it: a bearing twice from one pose tells no more than once. What else may make
// a system singular depends on the estimates, and is a solver's to find.
std::vector<Finding> check(const Graph& graph);

}  // namespace sg::graph
