// The trajectory format of the TUM RGB-D benchmark (Sturm et al. 2012): a line a pose,
//   timestamp x y z qx qy qz qw
// by ascending id, which stands for the time where WriteOptions has none: reading wants it to be a whole number. A planar pose
// lies in z = 0 and turns about z. Read, it is a graph of poses without an edge.
#pragma once

#include "formats/convert.h"
#include "formats/formats.h"

namespace sg::formats {

// Whether vertex v is a pose that a trajectory can have; its estimate as x y z qx qy qz qw, appended.
bool is_trajectory_pose(const Graph& graph, Index v);
void append_pose(const Graph& graph, Index v, std::string& out);

// Poses need VERTEX lines with estimates.
Losses tum_losses(const Graph& graph);
void write_tum(const Graph& graph, const WriteOptions& options, Sink& sink);

// Whether the first line that is neither blank nor a comment has eight words, the first a number.
bool looks_like_tum(std::string_view text);
std::string tum_to_g2o(std::string_view text, const std::string& file, const Complaint& complaint);

}  // namespace sg::formats
