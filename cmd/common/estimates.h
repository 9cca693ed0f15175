// Estimates back into a graph's text.
#pragma once

#include <span>
#include <vector>

#include "formats/write.h"
#include "lib/factor/problem.h"

namespace sg::cmd {

// VERTEX lines for a file that has none, before its first edge, in the order of `vertices`.
formats::Edit vertex_lines(const factor::Problem& problem, const factor::Values& values,
                           std::span<const Index> vertices);

// The changes that give every vertex of `moved` its estimate: the numbers of its VERTEX line, or,
// in a file without VERTEX lines, a line for every vertex before the first edge. What stands behind
// the numbers, and everything else, stays as it is.
formats::Changes estimate_changes(const factor::Problem& problem, const factor::Values& values,
                                  const std::vector<bool>& moved);

}  // namespace sg::cmd
