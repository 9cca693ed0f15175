// What benchmarks count as work.
#pragma once

namespace sg::bench {

// Multiplications and additions of eliminating f of n columns of a dense symmetric matrix; n^3 / 3 of all.
inline double operations(double f, double n) {
  return f * (n * n - n * f + f * f / 3);
}

}  // namespace sg::bench
