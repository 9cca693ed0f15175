// The trajectory format of the TUM RGB-D benchmark (Sturm et al. 2012): a line a pose,
//   timestamp x y z qx qy qz qw
// by ascending id, which stands for the time. A planar pose lies in z = 0 and turns about z.
#pragma once

#include "formats/convert.h"

namespace sg {

// Poses need VERTEX lines with estimates.
Losses tum_losses(const Graph& graph);
void write_tum(const Graph& graph, const WriteOptions& options, Sink& sink);

}  // namespace sg
