// What leaves a window by age, as far as it is decided, and the plan of a step with that: turn by turn the oldest pose with
// what no later one has seen, and where the newest alone is left, its landmarks one by one.
#pragma once

#include <limits>

#include "lib/solve/isam2_steps.h"
#include "lib/solve/isam2_window.h"

namespace sg::solve {

struct Leaving {
  struct Turn {  // as it was before it
    std::size_t variables, images;
    Index first;
    bool pose;     // leaves
    double freed;  // of EC_BT, as it is thought
  };
  std::vector<Index> variables;
  std::vector<Index> images;  // rows that are forgotten
  std::vector<Turn> turn;

  Index turns() const { return static_cast<Index>(turn.size()); }
};

// How many turns let those go that are too old.
Index turns_by_age(const Isam2Window& window, Index k);

// The plan of step k after so many turns.
CliqueTree plan_with(Isam2Window& window, const Entering& entering, Index k, Index turns,
                     Leaving& leaving);

// About as few turns as bring the plan below the budget, `least` at least. The search starts from what the step before
// took, and goes by what turns are thought to free: most of the time one plan or two are made. Where `most` turns are not
// enough, the plan is that of so many, above the budget.
CliqueTree plan_within(Isam2Window& window, const Entering& entering, Index k, Index least,
                       Leaving& leaving, Index most = std::numeric_limits<Index>::max());

}  // namespace sg::solve
