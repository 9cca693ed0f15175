// The table of sg-solve --time.
#pragma once

#include <string>
#include <vector>

#include "cmd/common/method.h"
#include "cmd/common/table.h"
#include "lib/elim/score.h"
#include "lib/factor/linearize.h"

namespace sg::solving {

// How long elimination takes, as --time measures it.
struct Timing {
  std::string file;
  std::string order;
  std::string backend;
  int threads;
  Index variables;
  Index factors;
  elim::Wide ec;
  int runs;
  double plan_s;
  double median_s;
  double cpu_s;
};

extern const std::vector<cmd::Column<Timing>> time_columns;

// Of one time at least; of an even number the later of the two in the middle.
double median(std::vector<double> times);

struct TimingOptions {
  int runs;  // eliminations under each ordering
  int threads;
  const std::string& backend;
  const cmd::MethodOptions& methods;
  const factor::Loss& loss;
};

// Of one ordering, `label` its name. Throws a computation Error where the system, of the problem at `values`, is singular.
Timing timed(const TimingOptions& options, const factor::Problem& problem,
             const factor::Values& values, factor::LinearSystem& system, const std::string& label,
             const graph::Order& order);
// A row an ordering, of the system at `values`.
void print_times(const TimingOptions& options, const factor::Problem& problem,
                 const factor::Values& values, cmd::Table<Timing>& table);

}  // namespace sg::solving
