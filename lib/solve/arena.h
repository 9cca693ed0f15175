// A block of numbers on a cache line's boundary, for frontal matrices.
#pragma once

#include <cstddef>
#include <memory>
#include <new>

namespace sg {

class Arena {
 public:
  Arena() = default;
  explicit Arena(std::size_t size)
      : numbers_(static_cast<double*>(::operator new(size * sizeof(double), alignment))),
        size_(size) {
    for (std::size_t i = 0; i < size; ++i) numbers_[i] = 0;
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
