// Numbers on a cache line's boundary, for frontal matrices.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <vector>

namespace sg::solve {

class Arena {
 public:
  Arena() = default;
  explicit Arena(
      std::size_t size);  // not set, nor had from the system before use; throws std::bad_alloc

  double* data() { return numbers_.get(); }
  const double* data() const { return numbers_.get(); }
  std::size_t size() const { return size_; }

 private:
  struct Release {
    void operator()(double* p) const { std::free(p); }
  };
  std::unique_ptr<double[], Release> numbers_;
  std::size_t size_ = 0;
};

// An array that grows by chunks and never moves: numbers within a chunk lie side by side, and so do
// all that one call of grow() added.
class ChunkedArena {
 public:
  static constexpr std::int64_t chunk = 1 << 18;  // two megabytes: a large page

  // At least `size` numbers from now on.
  void grow(std::int64_t size) {
    const auto missing = (size + chunk - 1) / chunk - static_cast<std::int64_t>(base_.size());
    if (missing <= 0) return;
    double* const begin = parts_.emplace_back(missing * chunk).data();
    for (std::int64_t k = 0; k < missing; ++k) base_.push_back(begin + k * chunk);
  }

  double* at(std::int64_t offset) {
    assert(0 <= offset && offset / chunk < static_cast<std::int64_t>(base_.size()));
    return base_[offset / chunk] + offset % chunk;
  }

 private:
  std::vector<Arena> parts_;
  std::vector<double*> base_;  // of every chunk
};

}  // namespace sg::solve
