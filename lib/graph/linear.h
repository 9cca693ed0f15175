// Linear factors: a Gaussian of any number of vertices jointly, which is what marginalization leaves behind.
//
//   EDGE_LINEAR           FIRST COUNT ID... x... d... W
//   EDGE_LINEAR_RELATIVE  FIRST COUNT ID... x... d... W
//
// COUNT ids follow the first. x: the linearization point, of every vertex what its VERTEX line would hold. Then
//     chi2 = (y - d)' W (y - d),
// with W's upper triangle row by row, where y is by how far the vertices have moved from x, a tangent vector of all of
// them: of EDGE_LINEAR the steps from x (lib/factor/space.h); of EDGE_LINEAR_RELATIVE, whose first vertex is a pose,
// those of the other vertices as seen from that pose, so that a motion of the whole changes nothing, however far it
// goes. What a camera has beside its pose is seen from nowhere, and stands first in y where the first vertex is one.
//
// Source: Carlevaris-Bianco, Kaess, Eustice, Generic node removal for factor-graph SLAM (2014), whose root-shifted
// linear constraints these are.
#pragma once

#include <span>
#include <vector>

#include "lib/graph/graph.h"

namespace sg::graph {

constexpr bool is_linear(EdgeTag type) {
  return type == EdgeTag::linear || type == EdgeTag::linear_relative;
}

// Of a linear factor over vertices of these spaces: the numbers x and d, and the dimension of y.
struct LinearSize {
  int measurement;
  int dim;
};
LinearSize linear_size(EdgeTag type, std::span<const Space> ends);

std::vector<Space> end_spaces(const Graph& graph, Index e);

}  // namespace sg::graph
