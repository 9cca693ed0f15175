// Graphviz: circles for poses, boxes for landmarks, diamonds for the rest; fixed vertices are
// filled. An edge between two vertices is a line (bold: odometry, dashed: loop closure); one that
// joins any other number of them is a point with a line to each.
#pragma once

#include "formats/convert.h"

namespace sg::formats {

void write_dot(const Graph& graph, const WriteOptions& options, Sink& sink);

}  // namespace sg::formats
