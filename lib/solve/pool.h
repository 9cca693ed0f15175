// Room in a growing array for blocks that come and go: sizes are rounded up to a few classes, and a
// block that is given back serves the next one of its class. In the steady state nothing is
// allocated. With a chunk size, no block lies across a multiple of it unless it is larger and
// begins at one, so that the array may grow by chunks (arena.h).
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>
#include <vector>

namespace sg::solve {

class Pool {
 public:
  explicit Pool(std::int64_t chunk = std::int64_t{1} << 62) : chunk_(chunk) {}

  // Where a block of `size` items begins; `size` is at least 1.
  std::int64_t take(std::int64_t size) {
    assert(size > 0);
    std::vector<std::int64_t>& free = free_of(size);
    if (!free.empty()) {
      const std::int64_t begin = free.back();
      free.pop_back();
      return begin;
    }
    const std::int64_t left = chunk_ - end_ % chunk_;
    if (rounded(size) > left) end_ += left % chunk_;
    end_ += rounded(size);
    return end_ - rounded(size);
  }

  // `size` as it was taken.
  void give(std::int64_t begin, std::int64_t size) { free_of(size).push_back(begin); }

  std::int64_t end() const { return end_; }  // the array needs as many items

 private:
  // Sizes of three significant bits, at least 8, multiples of 8: a block stays on its cache line.
  static std::int64_t rounded(std::int64_t size) {
    const std::int64_t eighths = (size + 7) / 8;
    const int shift = std::max(0, static_cast<int>(std::bit_width(std::uint64_t(eighths))) - 3);
    return (((eighths - 1) >> shift) + 1) << shift << 3;
  }
  std::vector<std::int64_t>& free_of(std::int64_t size) {
    const auto eighths = static_cast<std::uint64_t>(rounded(size) / 8);
    const int shift = std::max(0, static_cast<int>(std::bit_width(eighths)) - 3);
    const std::size_t kind = shift * 8 + (eighths >> shift);
    if (kind >= free_.size()) free_.resize(kind + 1);
    return free_[kind];
  }

  std::vector<std::vector<std::int64_t>> free_;  // beginnings, by class
  std::int64_t chunk_;
  std::int64_t end_ = 0;
};

}  // namespace sg::solve
