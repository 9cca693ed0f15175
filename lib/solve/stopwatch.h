// Seconds by the wall clock, for shares of a time alone: a clock of the processor may tick in milliseconds.
#pragma once

#include <chrono>

namespace sg::solve {

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace sg::solve
