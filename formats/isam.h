// iSAM's text format, which knows measurements only:
//
//   ODOMETRY i j   x y theta              r11 r12 r13 r22 r23 r33   (also EDGE2, Constraint2)
//   EDGE3    i j   x y z roll pitch yaw   r11 ... r66               (21 numbers, or none)
//   LANDMARK i l   x y                    r11 r12 r22
//   POINT3   i l   x y z                  r11 ... r33               (6 numbers, or none)
//
// r is the upper triangular square root of the information, W = R^T R, row by row; where none may be
// and none is, the identity. Loop closures carry the tag ODOMETRY, too. Landmarks are numbered apart
// from poses: landmark l becomes the vertex with id M + 1 + l, M being the largest pose id, so that
// landmarks stand after poses in the order of their own numbers. Rotations and their information:
// euler.h. SOLVE, and the lines by which iSAM starts or judges poses (POSE3D_INIT, EDGE3_INIT,
// POSE3D_TRUE, EDGE3_TRUE), measure nothing and become comments. Other tags are g2o's.
// Source: the loader of iSAM 1.7 (Kaess).
#pragma once

#include "formats/convert.h"
#include "formats/formats.h"

namespace sg::formats {

bool looks_like_isam(std::string_view text);
bool isam_begins(std::string_view word);
std::string isam_to_g2o(std::string_view text, const std::string& file, const Complaint& complaint);

// Estimates are lost, vertices without an edge, and the ids of landmarks below that of a pose:
// landmark v becomes v - M - 1 where all landmarks stand after the poses, so that reading brings its
// id back, and keeps its number otherwise. The writer throws an input Error for information that is
// not positive semidefinite, hence has no square root.
Losses isam_losses(const Graph& graph);
void write_isam(const Graph& graph, const WriteOptions& options, Sink& sink);

}  // namespace sg::formats
