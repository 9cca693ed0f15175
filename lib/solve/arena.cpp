#include "lib/solve/arena.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>
#include <new>

namespace sg::solve {
namespace {

constexpr std::size_t line = 64;
constexpr std::size_t huge_page = std::size_t{1} << 21;

}  // namespace

Arena::Arena(std::size_t size) : size_(size) {
  const std::size_t bytes = size * sizeof(double);
  const std::size_t page = bytes >= huge_page ? huge_page : line;
  const std::size_t rounded = (bytes + page - 1) / page * page;
  numbers_.reset(static_cast<double*>(std::aligned_alloc(page, std::max(rounded, page))));
  if (!numbers_) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
  // Small pages take the system longer to hand out than an elimination takes to fill them.
  if (page == huge_page) madvise(numbers_.get(), rounded, MADV_HUGEPAGE);
#endif
}

}  // namespace sg::solve
