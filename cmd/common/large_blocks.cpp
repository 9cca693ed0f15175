// Memory by large pages. A command on a graph of a million poses is at nothing as long as at being given its memory, page by
// page of 4 kB: half of what scoring takes, a third of reading. A kernel that may give 2 MB at a time does so where it is asked;
// large blocks ask. (Under the sanitizers, which have a new of their own, they don't.)
#include <sys/mman.h>

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <new>

namespace {

constexpr std::size_t large_page = std::size_t{1} << 21;

// For the pages that the block lies in, with what else lies there: it is a wish.
void ask_for_large_pages(void* block, std::size_t bytes) {
  const std::size_t before = reinterpret_cast<std::uintptr_t>(block) % large_page;
  const std::size_t pages = (before + bytes + large_page - 1) / large_page;
  const int error = errno;
  ::madvise(static_cast<char*>(block) - before, pages * large_page, MADV_HUGEPAGE);
  errno = error;
}

}  // namespace

void* operator new(std::size_t bytes) {
  while (true) {
    if (void* const block = std::malloc(bytes == 0 ? 1 : bytes)) {
      if (bytes >= large_page / 2) ask_for_large_pages(block, bytes);
      return block;
    }
    if (const std::new_handler handler = std::get_new_handler())
      handler();
    else
      throw std::bad_alloc();
  }
}
void operator delete(void* block) noexcept {
  std::free(block);
}
void operator delete(void* block, std::size_t) noexcept {
  std::free(block);
}
