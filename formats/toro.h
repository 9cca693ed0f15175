// TORO's text format:
//
//   VERTEX2 i     x y theta
//   EDGE2   i j   x y theta              w11 w12 w22 w33 w13 w23   (in TORO's own order)
//   VERTEX3 i     x y z roll pitch yaw
//   EDGE3   i j   x y z roll pitch yaw   w11 ... w66               (the upper triangle, row by row)
//   EQUIV   i j
//
// w is the information; an EDGE3 without it has the identity. VERTEX and EDGE are the names under
// which TORO saves VERTEX2 and EDGE2. EQUIV asks the optimizer to merge two vertices that an edge
// joins; it measures nothing, and here the edge stays and the line becomes a comment. Rotations and
// their information: euler.h. Other tags are g2o's.
// Source: TORO's own loader (Grisetti, Stachniss).
#pragma once

#include "formats/convert.h"
#include "formats/formats.h"

namespace sg::formats {

bool looks_like_toro(std::string_view text);
bool toro_begins(std::string_view word);
// Of a text whose only tags are EDGE2 and EDGE3, which iSAM has, too: whether every EDGE2 has a
// positive diagonal if the numbers are TORO's, and some have not if they are iSAM's.
bool rather_toro(std::string_view text);
std::string toro_to_g2o(std::string_view text, const std::string& file, const Complaint& complaint);

Losses toro_losses(const Graph& graph);
void write_toro(const Graph& graph, const WriteOptions& options, Sink& sink);

}  // namespace sg::formats
