// Seconds by the wall clock: for budgets, and for shares of a time.
#pragma once

#include <chrono>

namespace sg::order {

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace sg::order
