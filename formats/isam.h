// iSAM's text format: ODOMETRY, LANDMARK, EDGE2, EDGE3, POINT3 with square-root information
// matrices.
#pragma once

#include "formats/formats.h"

namespace sg {

bool looks_like_isam(std::string_view text);
std::string isam_to_g2o(std::string_view text, const std::string& file, const Complaint& complaint);

}  // namespace sg
