#include "lib/solve/isam2_returns.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sg::solve {
namespace {

constexpr double kept = 0.998;         // of a count, a step later
constexpr double class_middle = 1.19;  // times its first age
// As if an edge had named what is seven times as old as the median: few edges make no steep tail.
constexpr double doubt = 2;

int class_of(Index age) {
  return std::min(Returns::classes - 1,
                  static_cast<int>(2 * std::log2(static_cast<double>(std::max<Index>(age, 1)))));
}
double first_age(int k) {
  return std::exp2(k / 2.0);
}

}  // namespace

void next_step(Returns& returns) {
  returns.steps = kept * returns.steps + 1;
  for (double& edges : returns.edges) edges *= kept;
}

void note_return(Returns& returns, Index age) {
  ++returns.edges[class_of(age)];
}

double expected_edges(const Returns& returns, Index age) {
  const int own = class_of(age);
  double sum = 0;
  for (int k = own; k < Returns::classes; ++k) {
    // Of its own class the part that is older.
    const double share = k > own ? 1 : (first_age(k + 1) - age) / (first_age(k + 1) - first_age(k));
    sum += std::clamp(share, 0.0, 1.0) * returns.edges[k];
  }
  return returns.steps > 0 ? sum / returns.steps : 0;
}

Tail tail_of(const Returns& returns) {
  const double all = std::accumulate(returns.edges.begin(), returns.edges.end(), 0.0);
  if (all == 0) return {};
  double upper = 0, logs = 0;
  int median = Returns::classes;
  while (upper < all / 2) upper += returns.edges[--median];
  for (int k = median; k < Returns::classes; ++k)
    logs += returns.edges[k] * std::log(class_middle * first_age(k) / first_age(median));
  return {upper / returns.steps, first_age(median), upper / (logs + doubt)};
}

double expected_edges(const Tail& tail, Index age) {
  return tail.edges * std::pow(std::max(1.0, age / tail.from), -tail.exponent);
}

}  // namespace sg::solve
