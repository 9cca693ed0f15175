// What it is worth to keep a pose of some age: how often edges come back to what is so old, and what they then tell.
//
// The age of what an edge names is how many steps ago the pose was the newest, or the landmark was last seen. Edges that
// name what has left count as those that come in: what they would have told is taken from others of their age, or else
// from those of the next lower age, in proportion. So a smoother that keeps too little learns of it.
//
// A pose is named by so many edges after age a as edges come in a step that name what is older than a. Counts fade over
// some hundred steps.
#pragma once

#include <array>
#include <optional>

#include "lib/graph/lists.h"

namespace sg::solve {

struct Returns {
  static constexpr int classes = 48;  // of age: two to a doubling
  struct Class {
    double edges = 0;   // that named such an age, faded
    double gain = 0;    // of those that were looked at: the sum, faded
    double looked = 0;  // and their number, faded
  };
  std::array<Class, classes> ages;
  double steps = 0;  // faded
};

void next_step(Returns& returns);
void note_return(Returns& returns, Index age, std::optional<double> gain);

// The expected gain of all edges that will name a pose that is so old now.
double expected_gain(const Returns& returns, Index age);

}  // namespace sg::solve
