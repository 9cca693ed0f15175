// iSAM's text format, which knows measurements only:
//
//   ODOMETRY i j   x y theta              r11 r12 r13 r22 r23 r33   (EDGE2 is another name for it)
//   EDGE3    i j   x y z roll pitch yaw   r11 ... r66               (21 numbers)
//   LANDMARK i l   x y                    r11 r12 r22
//   POINT3   i l   x y z                  r11 ... r33               (6 numbers)
//
// r is the upper triangular square root of the information, W = R^T R, row by row. Loop closures
// carry the tag ODOMETRY, too. Landmarks are numbered apart from poses: landmark l becomes the
// vertex with id M + 1 + l, M being the largest pose id, so that landmarks stand after poses in the
// order of their own numbers. Rotations and their information: euler.h. Other tags are g2o's.
// Source: the loader of iSAM 1.7 (Kaess).
#pragma once

#include "formats/convert.h"
#include "formats/formats.h"

namespace sg::formats {

bool looks_like_isam(std::string_view text);
std::string isam_to_g2o(std::string_view text, const std::string& file, const Complaint& complaint);

// Estimates are lost, and vertices without an edge. Landmark v becomes v - M - 1 where all
// landmarks stand after the poses, so that reading brings its id back, and keeps its number
// otherwise.
Losses isam_losses(const Graph& graph);
void write_isam(const Graph& graph, const WriteOptions& options, Sink& sink);

}  // namespace sg::formats
