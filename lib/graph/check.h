// What is wrong with a graph that could be read. (What keeps a line from being read is the
// reader's to say.)
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lib/graph/graph.h"

namespace sg::graph {

// note: what is no defect, but worth to know.
enum class Severity : std::uint8_t { error, warning, note };

struct Finding {
  Offset line;  // `implied` where no line is meant
  Severity severity;
  std::string cause;
};
using Findings = std::vector<Finding>;

// Errors: numbers that are infinite or none, information that is not positive semidefinite,
// quaternions of length zero, edges that join a vertex to itself or one of the wrong kind, parameters
// that are missing, of the wrong kind or given twice, landmarks that their observations cannot
// determine. Warnings: quaternions far from unit length, numbers past the end of a line, information
// that is zero, parts that nothing connects to the rest.
//
// A text holds the upper triangle of an information matrix only: it is symmetric as it stands. It
// counts as semidefinite down to an eigenvalue of -1e-9 times the largest. A quaternion is far from
// unit length by 1e-3.
//
// A landmark is determined if one measurement of it has its dimension, or if those from different
// vertices add up to it: a bearing twice from one pose tells no more than once. What else may make
// a system singular depends on the estimates (lib/factor/plausible.h).
//
// By line.
Findings check(const Graph& graph);

}  // namespace sg::graph
