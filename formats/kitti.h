// The pose files of the KITTI odometry benchmark (Geiger et al. 2012): a line a pose, the upper three
// rows of its 4 x 4 matrix (camera to world), row by row: twelve numbers. Line by line the poses have
// the ids 0, 1, 2, ... Read, it is a graph of poses without an edge.
#pragma once

#include "formats/convert.h"
#include "formats/formats.h"

namespace sg::formats {

// Poses need VERTEX lines with estimates. Ids that are not 0, 1, 2, ... are lost.
Losses kitti_losses(const Graph& graph);
void write_kitti(const Graph& graph, const WriteOptions& options, Sink& sink);

// Whether the first line that is neither blank nor a comment has twelve words, the first a number.
bool looks_like_kitti(std::string_view text);
std::string kitti_to_g2o(std::string_view text, const std::string& file,
                         const Complaint& complaint);

}  // namespace sg::formats
