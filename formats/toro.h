// TORO's text format:
//
//   VERTEX2 i     x y theta
//   EDGE2   i j   x y theta              w11 w12 w22 w33 w13 w23   (in TORO's own order)
//   VERTEX3 i     x y z roll pitch yaw
//   EDGE3   i j   x y z roll pitch yaw   w11 ... w66               (the upper triangle, row by row)
//
// w is the information. Rotations and their information: euler.h. Other tags are g2o's.
// Source: TORO's own loader (Grisetti, Stachniss).
#pragma once

#include "formats/convert.h"
#include "formats/formats.h"

namespace sg::formats {

bool looks_like_toro(std::string_view text);
std::string toro_to_g2o(std::string_view text, const std::string& file, const Complaint& complaint);

Losses toro_losses(const Graph& graph);
void write_toro(const Graph& graph, const WriteOptions& options, Sink& sink);

}  // namespace sg::formats
