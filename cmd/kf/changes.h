// What sg-kf changes of a graph.
#pragma once

#include "formats/write.h"
#include "lib/prune/keyframes.h"

namespace sg::kf {

// After a sweep of landmarks with fewer than min_obs observations. They hold a reference to the keyframing.
formats::Changes changes(const prune::Keyframing& keyframing, Index min_obs);

}  // namespace sg::kf
