#include "lib/solve/isam2_returns.h"

#include <algorithm>
#include <cmath>

namespace sg::solve {
namespace {

constexpr double kept = 0.998;  // of a count, a step later

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
  for (Returns::Class& c : returns.ages) {
    c.edges *= kept;
    c.gain *= kept;
    c.looked *= kept;
  }
}

void note_return(Returns& returns, Index age, std::optional<double> gain) {
  Returns::Class& c = returns.ages[class_of(age)];
  ++c.edges;
  if (!gain) return;
  c.gain += *gain;
  ++c.looked;
}

double expected_gain(const Returns& returns, Index age) {
  const int own = class_of(age);
  double sum = 0, mean = 0, of_age = 1;
  for (int k = 0; k < Returns::classes; ++k) {
    const Returns::Class& c = returns.ages[k];
    if (c.looked > 0.01) {
      mean = c.gain / c.looked;
      of_age = first_age(k);
    }
    if (k < own || c.edges == 0) continue;
    // Of its own class the part that is older.
    const double a = first_age(k);
    const double share = k > own ? 1 : (first_age(k + 1) - age) / (first_age(k + 1) - a);
    sum += std::clamp(share, 0.0, 1.0) * c.edges * mean * a / of_age;
  }
  return returns.steps > 0 ? sum / returns.steps : 0;
}

}  // namespace sg::solve
