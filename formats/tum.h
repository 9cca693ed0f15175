// The trajectory format of the TUM RGB-D benchmark (Sturm et al. 2012): a line a pose,
//   timestamp x y z qx qy qz qw
// by ascending id, which stands for the time. A planar pose lies in z = 0 and turns about z.
#pragma once

#include <array>

#include "formats/convert.h"

namespace sg::formats {

// Poses need VERTEX lines with estimates.
Losses tum_losses(const Graph& graph);
void write_tum(const Graph& graph, const WriteOptions& options, Sink& sink);

// Reading it as a trajectory: it has no edges, hence is no graph.
struct TumPose {
  Id id;                          // the time, which has to be a whole number
  std::array<double, 7> numbers;  // x y z qx qy qz qw
};
// Whether the first line that is neither blank nor a comment starts with a number.
bool looks_like_tum(std::string_view text);
// By ascending id. Throws an input Error for a line of another form, or an id that comes twice.
std::vector<TumPose> read_tum(std::string_view text, const std::string& file);

}  // namespace sg::formats
