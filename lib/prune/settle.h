// What measurements have added to what a graph knows of its poses' positions (information_gain.h), exactly.
//
// What was added tells its exact share when it is settled, all at once: the columns of L'^-1 U (I + C)^-1/2, squared, are
// by what the variances fell, measurement by measurement.
#pragma once

#include <vector>

#include "lib/prune/information_gain.h"

namespace sg::prune {

struct Settled {
  Gain gain;          // exact
  double mean_sigma;  // after it
};
// The exact gains of what was added, in order; variances follow. The factor is to be renewed then.
std::vector<Settled> settle(Knowledge& knowledge);

}  // namespace sg::prune
