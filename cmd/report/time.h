// How long it may take: a budget of seconds, and an interruption.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>

#include "cmd/common/interrupt.h"
#include "cmd/common/stage.h"

namespace sg::report {

struct Deadline {
  std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
  double seconds;

  double left() const { return cmd::interrupted() ? 0 : seconds - cmd::seconds_since(begin); }
  bool passed() const { return left() <= 0; }
};
// This part of what is left.
inline Deadline part(const Deadline& whole, double share) {
  return {.seconds = whole.left() * share};
}

}  // namespace sg::report
