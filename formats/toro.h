// TORO's text format: VERTEX2, EDGE2, VERTEX3, EDGE3; information in TORO's own order, rotations as
// roll, pitch, yaw.
#pragma once

#include "formats/formats.h"

namespace sg {

bool looks_like_toro(std::string_view text);
std::string toro_to_g2o(std::string_view text, const std::string& file, const Complaint& complaint);

}  // namespace sg
