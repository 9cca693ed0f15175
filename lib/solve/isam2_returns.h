// Whether it is worth to keep a pose of some age: how often edges come back to what is so old.
//
// The age of what an edge names is how many steps ago the pose was the newest, or the landmark was last seen. Edges that
// name what has left count as those that come in. A pose is named by so many edges after age a as edges come in a step that
// name what is older than a. Counts fade over some hundred steps.
#pragma once

#include <array>

#include "lib/graph/lists.h"

namespace sg::solve {

struct Returns {
  static constexpr int classes = 48;    // of age: two to a doubling
  std::array<double, classes> edges{};  // that named such an age, faded
  double steps = 0;                     // faded
};

void next_step(Returns& returns);
void note_return(Returns& returns, Index age);

// How many edges will name a pose that is so old now, by the counts: none where nothing so old has been named of late.
double expected_edges(const Returns& returns, Index age);

// The same for what is older than anything that has been named: by the power law through the upper half of the ages (Hill, A
// simple general approach to inference about the tail of a distribution, 1975). Steep where edges come back after a lap, and
// always the same one; flat where they come back from anywhere, and as long as nothing is known.
struct Tail {
  double edges = 1;  // a step, that name what is older than `from`
  double from = 1;
  double exponent = 0;
};
Tail tail_of(const Returns& returns);
double expected_edges(const Tail& tail, Index age);

}  // namespace sg::solve
