// A progress line for work of over a second, where standard error is a terminal, and never
// otherwise.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace sg::cmd {

class Progress {
 public:
  // "sg-isam2: step 120 of 3500"; without a total (0) only the count.
  Progress(std::string command, std::string what, std::int64_t total);
  ~Progress();  // wipes the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(std::int64_t done);

 private:
  using Clock = std::chrono::steady_clock;
  std::string label_;
  std::int64_t total_;
  bool terminal_;
  bool shown_ = false;
  Clock::time_point next_;
};

}  // namespace sg::cmd
