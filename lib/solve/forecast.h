// What eliminating by the Bayes tree (eliminate.h) will take under an order, told from structure alone: no factor is
// formed, nor are the cliques' variables listed. Near-linear in the size of A.
//
// Bytes are exact: what plan_elimination allocates for one thread.
//
// Seconds are a model's. EC counts multiplications as if each took as long; but a small front has more to it than those,
// and numbers are also cleared, summed up, and written for the parent. So the work is counted by kinds (below), each of
// which takes a time of its own on a machine, and the sum is what an elimination on one thread takes. The times are fitted
// (fit_times) to eliminations that were timed there.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "lib/elim/score.h"
#include "lib/graph/pattern.h"
#include "lib/solve/eliminate.h"

namespace sg::solve {

// What the factor holds as Elimination keeps it, all that solving by it needs: its numbers; the variables of cliques,
// frontal and in separators; cliques' sizes and where their numbers begin; variables' dimensions and where their steps
// begin.
std::int64_t factor_bytes(const Elimination& elimination);
// The same and the updates that wait to be summed up: what an elimination holds. Beside that there are the linearized
// system, and lists of where its rows go.
std::int64_t peak_bytes(const Elimination& elimination);

// Kinds of work, in the order of an array of them. Here a front has f frontal scalars, s in its separator, n = f + s + 1.
struct Kind {
  std::string_view name;
  std::string_view what;
};
inline constexpr std::array kinds{
    Kind{"front", "fronts"},
    Kind{"pivot", "f"},
    Kind{"factor", "numbers of the factor, f n"},
    Kind{"update", "numbers of updates that are formed, (n - f)^2"},
    Kind{"product", "multiplications of small fronts, f (n^2 - f n + f^2 / 3)"},
    Kind{"panel", "those of fronts that are factorized by panels"},
    Kind{"row", "rows assembled"},
    Kind{"gram", "their numbers, squared by width and times the largest dimension"},
    Kind{"block", "pairs of variables in children's separators"},
    Kind{"outer", "numbers that leaves without an update take from their parents, times f"},
};
using Work = std::array<double, kinds.size()>;

struct Forecast {
  std::int64_t factor_bytes = 0;
  std::int64_t peak_bytes = 0;
  Work work{};
};
// Throws std::invalid_argument if `order` is no permutation.
Forecast forecast(const graph::Pattern& pattern, const graph::Order& order);
// The same where the symbolic elimination is known.
Forecast forecast(const graph::Pattern& pattern, const graph::Order& order,
                  const elim::Symbolic& symbolic);

// Nanoseconds of every kind's unit.
using Times = std::array<double, kinds.size()>;
double seconds(const Work& work, const Times& times);

struct Sample {
  Work work;
  double seconds;
};
// The times, none below 0, that minimize the sum of squared relative errors. Of no samples: zeros.
Times fit_times(std::span<const Sample> samples);

}  // namespace sg::solve
