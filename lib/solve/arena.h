// A block of numbers on a cache line's boundary, for frontal matrices.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <utility>

namespace sg {

class Arena {
 public:
  Arena() = default;
  explicit Arena(std::size_t size)
      : numbers_(static_cast<double*>(::operator new(size * sizeof(double), alignment))),
        size_(size) {
    for (std::size_t i = 0; i < size; ++i) numbers_[i] = 0;
  }

  // At least `size` numbers from now on; those that were there stay.
  void grow(std::size_t size) {
    if (size <= size_) return;
    Arena larger(std::max(size, 2 * size_));
    std::copy_n(data(), size_, larger.data());
    *this = std::move(larger);
  }

  double* data() { return numbers_.get(); }
  const double* data() const { return numbers_.get(); }
  std::size_t size() const { return size_; }

 private:
  static constexpr std::align_val_t alignment{64};
  struct Release {
    void operator()(double* p) const { ::operator delete(p, alignment); }
  };
  std::unique_ptr<double[], Release> numbers_;
  std::size_t size_ = 0;
};

}  // namespace sg
