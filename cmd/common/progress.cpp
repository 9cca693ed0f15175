#include "cmd/common/progress.h"

#include <unistd.h>

#include <iostream>

namespace sg::cmd {

Progress::Progress(std::string command, std::string what, std::int64_t total)
    : label_(std::move(command) + ": " + std::move(what) + " "),
      total_(total),
      terminal_(::isatty(STDERR_FILENO) != 0),
      next_(Clock::now() + std::chrono::seconds(1)) {}

Progress::~Progress() {
  if (shown_) std::cerr << "\r\x1b[K" << std::flush;
}

void Progress::update(std::int64_t done) {
  if (!terminal_ || Clock::now() < next_) return;
  next_ = Clock::now() + std::chrono::milliseconds(100);
  shown_ = true;
  std::cerr << "\r" << label_ << done;
  if (total_ > 0) std::cerr << " of " << total_;
  std::cerr << "\x1b[K" << std::flush;
}

}  // namespace sg::cmd
