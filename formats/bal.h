// The text format of bundle adjustment in the large (BAL):
//
//   CAMERAS POINTS OBSERVATIONS
//   CAMERA POINT x y           an observation a line; both counted from 0
//   w1 w2 w3 t1 t2 t3 f k1 k2  of every camera, in one line or several, mostly nine
//   X Y Z                      of every point, likewise
//
// A camera maps the world to its frame, R = exp([w]x): its line holds the inverse (types.h). Camera i
// becomes vertex i, point j vertex CAMERAS + j; an observation has the identity for information.
// Source: grail.cs.washington.edu/projects/bal (Agarwal, Snavely, Seitz, Szeliski).
#pragma once

#include "formats/convert.h"
#include "formats/formats.h"

namespace sg::formats {

// Whether the first line is three counts, and the second, if there is one, two numbers of vertices and
// more.
bool looks_like_bal(std::string_view text);
std::string bal_to_g2o(std::string_view text, const std::string& file, const Complaint& complaint);

Losses bal_losses(const Graph& graph);
void write_bal(const Graph& graph, const WriteOptions& options, Sink& sink);

}  // namespace sg::formats
