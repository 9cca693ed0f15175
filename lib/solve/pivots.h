// When a pivot has vanished.
//
// In exact arithmetic a scalar that the measurements leave undetermined has a pivot of 0; what
// rounding leaves of it is some units in the last place of the numbers that it was subtracted from.
// A pivot that is not above its floor,
//
//     vanishing * max over factors r of (A_r' A_r)_kk,
//
// is taken for such a rest, by every solver here. A single factor's entry is the yardstick since it
// says in which unit the scalar is measured; their sum would grow with the number of measurements,
// and damping would hide what is to be found. NaN is above nothing.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "lib/factor/linearize.h"
#include "lib/solve/front.h"

namespace sg::solve {

constexpr double vanishing = 1e-14;

// The floor of a scalar, once a factor with this diagonal entry is seen.
inline void raise_floor(double& floor, double diagonal) {
  floor = std::max(floor, vanishing * diagonal);
}

// The floors of all scalars of a system; at: by variable, where its first scalar's is.
void set_floors(const factor::LinearSystem& system, std::span<const Index> at,
                std::span<double> floors);

// After Kernels::factorize: appends those of the front's frontal variables with a scalar whose pivot
// was dropped.
void append_vanished(const Front& front, std::span<const Index> frontals, std::span<const int> dim,
                     std::vector<Index>& variables);

}  // namespace sg::solve
